// Tells what the checks found.
#pragma once

#include <string>
#include <vector>

#include "doctor/checks.h"

namespace understudy::doctor {

struct Result {
  const Check* check = nullptr;
  Finding finding{};
};

// Judges every check, in their order.
std::vector<Result> Judge(const Evidence& evidence);

// Returns whether a finding is wrong.
bool AnyWrong(const std::vector<Result>& results);

// One line for each, in columns: verdict, name, finding, and behind an arrow what to do; then a
// line that counts them.
std::string ReportText(const std::vector<Result>& results);

// One JSON document, docs/doctor.md. Bytes that are not UTF-8 are replaced.
std::string ReportJson(const Question& question, const std::vector<Result>& results);

}  // namespace understudy::doctor
