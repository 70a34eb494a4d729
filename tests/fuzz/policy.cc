// Bytes as weights and as a definition of a policy: a network that is read gives numbers for
// numbers.
#include "policy/policy.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/errors.h"

namespace {

using namespace understudy;  // NOLINT(google-build-using-namespace)

void TryWeights(const std::string& bytes) {
  policy::Network network = policy::MakeNetwork(policy::ParseTensors(bytes, "fuzz"), "fuzz");
  const Eigen::VectorXf input = Eigen::VectorXf::Zero(network.inputs());
  if (network.Run(input).size() != network.outputs()) std::abort();
}

void TryDefinition(const std::string& text) {
  const policy::Definition definition = policy::ParseDefinition(text, "fuzz.yaml");
  if (definition.step_dt <= 0 || policy::Width(definition) == 0) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const auto attempt : {TryWeights, TryDefinition}) {
    try {
      attempt(bytes);
    } catch (const SetupError&) {
      // What most bytes are, said in words.
    }
  }
  return 0;
}
