#include "base/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <unistd.h>

#include "base/printed.h"

namespace understudy {

std::string ProgressText(const std::string& what, double done, double whole, double elapsed,
                         ProgressOf of) {
  constexpr int kWidth = 20;
  const bool steps = of == ProgressOf::kSteps;
  const double share = whole > 0 ? std::clamp(done / whole, 0.0, 1.0) : 0;
  const auto filled = static_cast<std::size_t>(std::floor(share * kWidth));
  std::string text = what + " [" + std::string(filled, '#') + std::string(kWidth - filled, '-') +
                     Printed("] %3.0f %%  ", 100 * share) +
                     (steps ? Printed("step %.0f of at most %.0f", done, whole)
                            : Printed("%.1f of %.1f s", done, whole));
  if (share > 0 && elapsed > 1) {  // before that nobody can tell
    text +=
        Printed(steps ? ", at most %.0f s to go" : ", %.0f s to go", elapsed * (1 - share) / share);
  }
  return text;
}

ProgressBar::ProgressBar(std::string what, ProgressOf of)
    : what_(std::move(what)), of_(of), terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputc('\n', stderr);
}

void ProgressBar::Show(double done, double whole, const std::string& note) {
  const Clock::time_point now = Clock::now();
  if (!terminal_ || (now < next_ && done < whole)) return;
  next_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  // Home, the text, and clear what is left of the line before.
  std::fprintf(stderr, "\r%s%s%s\033[K", ProgressText(what_, done, whole, elapsed, of_).c_str(),
               note.empty() ? "" : "  ", note.c_str());
}

}  // namespace understudy
