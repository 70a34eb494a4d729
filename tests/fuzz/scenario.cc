// Bytes as a scenario: its expectations, the runs of its campaign and its stages.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/errors.h"
#include "rehearse/expectations.h"
#include "rehearse/stages.h"
#include "rehearse/vary.h"
#include "schema/yaml_document.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const schema::YamlValue document = schema::ParseYaml(text, "fuzz.yaml");
    if (const schema::YamlValue* expect = document.Find("expect")) {
      rehearse::ReadExpectations(*expect, signals::RunningNames());
    }
    if (const schema::YamlValue* stages = document.Find("stages")) rehearse::ReadStages(*stages);
    if (const schema::YamlValue* vary = document.Find("vary")) {
      const rehearse::Plan plan(*vary);
      for (const std::size_t run : plan.Samples()) plan.Of(run);
    }
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
