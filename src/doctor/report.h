// Tells what the checks found.
#pragma once

#include <string>
#include <vector>

#include "doctor/checks.h"

namespace understudy::doctor {

struct CheckResult {
  const Check* check = nullptr;
  Finding finding{};
};

// Judges every check, in their order.
std::vector<CheckResult> Judge(const Measurements& evidence);

// Returns whether a finding is wrong.
bool AnyWrong(const std::vector<CheckResult>& results);

// One line for each, in columns: verdict, name, finding, and behind an arrow what to do; then a
// line that counts them.
std::string ReportText(const std::vector<CheckResult>& results);

// One JSON document, docs/reference/doctor.md. Bytes that are not UTF-8 are replaced.
std::string ReportJson(const Question& question, const std::vector<CheckResult>& results);

}  // namespace understudy::doctor
