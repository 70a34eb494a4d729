// Bytes as a script.
#include "script/script.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/errors.h"
#include "config/yaml_document.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const config::YamlValue document = config::ParseYaml(text, "fuzz.yaml");
    if (script::IsScript(document)) script::ReadScript(document, signals::RunningNames());
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
