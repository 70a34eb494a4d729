#include "policy/policy.h"

#include <string>
#include <utility>

#include "base/errors.h"

namespace understudy::policy {

Policy::Policy(Definition definition, Network network, std::span<const MotorName> motors,
               const std::string& robot)
    : interpreter_(std::move(definition), motors, robot), network_(std::move(network)) {
  CheckWidths(interpreter_.definition(), network_);
}

void CheckWidths(const Definition& definition, const Network& network) {
  const std::string weights = definition.weights.string();
  const auto inputs = static_cast<std::size_t>(network.inputs());
  if (const std::size_t width = Width(definition); inputs != width) {
    std::string terms;
    for (const Term& term : definition.terms) {
      terms += (terms.empty() ? "" : ", ") + std::string(term.row->name) + " " +
               std::to_string(Width(term, definition)) +
               (term.history > 1 ? " x " + std::to_string(term.history) : "");
    }
    throw ConfigError(weights + ": the network takes " + std::to_string(inputs) +
                      " numbers; the observations of " + definition.name + " are " +
                      std::to_string(width) + ": " + terms);
  }
  const auto outputs = static_cast<std::size_t>(network.outputs());
  if (const std::size_t actions = definition.action.joints.size(); outputs != actions) {
    throw ConfigError(weights + ": the network gives " + std::to_string(outputs) +
                      " actions; JointPositionAction of " + definition.name + " has " +
                      std::to_string(actions));
  }
}

Policy LoadPolicy(const std::filesystem::path& definition, std::span<const MotorName> motors,
                  const std::string& robot) {
  Definition read = ReadDefinition(definition);
  const std::string weights = read.weights.string();
  Network network = MakeNetwork(ReadTensors(weights), weights);
  return {std::move(read), std::move(network), motors, robot};
}

}  // namespace understudy::policy
