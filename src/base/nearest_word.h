// Finds the known word closest to a misspelt one, for "did you mean".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace understudy {

// The word of `words` with the least edit distance to `typed`, the first of equals; "" when even
// that one is further away than half of its letters (at least one letter may always be wrong).
// Letter case does not count.
std::string NearestWord(std::string_view typed, const std::vector<std::string>& words);

// How such a word ends an error line: "; did you mean 'timeout'? (valid: mode, timeout)".
// The question is left out when no word is near.
std::string DidYouMean(std::string_view typed, const std::vector<std::string>& words);

}  // namespace understudy
