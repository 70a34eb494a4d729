// Finds the known word closest to a misspelt one, for "did you mean".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace understudy {

// Returns the first of `words` with the least edit distance to `typed`; "" if that distance is more
// than half of the word's letters, rounded up where the first one is right (one wrong letter is
// always allowed). Ignores case.
std::string NearestWord(std::string_view typed, const std::vector<std::string>& words);

// Returns the end of an error line: "; did you mean 'timeout'?", or "" if no word is near.
std::string NearestHint(std::string_view typed, const std::vector<std::string>& words);

// Returns the same with all words: "; did you mean 'timeout'? (valid: mode, timeout)", without the
// question if no word is near.
std::string DidYouMean(std::string_view typed, const std::vector<std::string>& words);

}  // namespace understudy
