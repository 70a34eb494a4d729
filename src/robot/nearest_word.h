// "Did you mean ...": the nearest of the valid words.
#ifndef UNDERSTUDY_ROBOT_NEAREST_WORD_H_
#define UNDERSTUDY_ROBOT_NEAREST_WORD_H_

#include <string>
#include <string_view>
#include <vector>

namespace understudy {

// Number of single-letter insertions, deletions and replacements between two words.
std::size_t EditDistance(std::string_view a, std::string_view b);

// The valid word with the least edit distance to `word`, the first one of several; "" when `valid`
// is empty.
std::string NearestWord(std::string_view word, const std::vector<std::string>& valid);

}  // namespace understudy

#endif  // UNDERSTUDY_ROBOT_NEAREST_WORD_H_
