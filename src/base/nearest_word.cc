#include "base/nearest_word.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <utility>

namespace understudy {
namespace {

char Lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// The Damerau-Levenshtein distance: two swapped neighbours, a frequent typing error, cost one.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = Lower(a[i - 1]) == Lower(b[j - 1]);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && Lower(a[i - 1]) == Lower(b[j - 2]) &&
          Lower(a[i - 2]) == Lower(b[j - 1])) {
        now[j] = std::min(now[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

}  // namespace

std::string NearestWord(std::string_view typed, const std::vector<std::string>& words) {
  constexpr std::size_t kLongest = 64;  // longer than any valid word; bounds the table
  if (typed.size() > kLongest) return "";
  std::string nearest;
  std::size_t least = kLongest;
  for (const std::string& word : words) {
    // A first letter that is right is seldom so by chance.
    const bool begun = !typed.empty() && !word.empty() && Lower(typed[0]) == Lower(word[0]);
    const std::size_t allowed = std::max<std::size_t>(1, (word.size() + (begun ? 1 : 0)) / 2);
    // Skips words whose length alone rules them out, since the tick calls this too.
    if (typed.size() > word.size() + allowed || typed.size() + allowed < word.size()) continue;
    const std::size_t distance = EditDistance(typed, word);
    if (distance <= allowed && distance < least) {
      least = distance;
      nearest = word;
    }
  }
  return nearest;
}

std::string NearestHint(std::string_view typed, const std::vector<std::string>& words) {
  const std::string nearest = NearestWord(typed, words);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

std::string DidYouMean(std::string_view typed, const std::vector<std::string>& words) {
  std::string text = NearestHint(typed, words);
  const bool none = text.empty();
  text += none ? "; valid: " : " (valid: ";
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : ", ") + (words[i].empty() ? std::string("\"\"") : words[i]);
  }
  return none ? text : text + ")";
}

}  // namespace understudy
