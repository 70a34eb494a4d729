// Bytes as a script: what it waits for has one answer, whatever the signals say.
#include "script/script.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/errors.h"
#include "judge/formula.h"
#include "schema/yaml_document.h"

namespace {

using namespace understudy;  // NOLINT(google-build-using-namespace)

// The conditions with the same value for all signals: `not` of one that is known is the other.
void Ask(const signals::Conditions& conditions, double value) {
  const std::vector<double> said(conditions.signals.size(), value);
  for (const judge::Formula& formula : conditions.formulas) {
    const double margin = judge::MarginOf(formula, said);
    const double negated = judge::MarginOf({.op = judge::Op::kNot, .parts = {formula}}, said);
    if (judge::IsKnown(margin) != judge::IsKnown(negated)) std::abort();
    if (judge::IsKnown(margin) && judge::Holds(margin) == judge::Holds(negated)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const schema::YamlValue document = schema::ParseYaml(text, "fuzz.yaml");
    if (!script::IsScript(document)) return 0;
    const script::Script read = script::ReadScript(document, signals::RunningNames());
    Ask(read.conditions, judge::kUnknown);
    Ask(read.conditions, 0);
    Ask(read.conditions, 1e300);
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
