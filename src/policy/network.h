// A network of dense layers in float32.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "policy/tensors.h"

namespace understudy::policy {

// Function between layers; the last layer has none. kElu has alpha 1.
enum class Activation : std::uint8_t { kNone, kElu, kRelu, kTanh };

// y = weight x + bias.
struct Layer {
  Eigen::MatrixXf weight;  // outputs by inputs
  Eigen::VectorXf bias;
};

class Network {
 public:
  // Each layer has as many inputs as the previous one has outputs; there is at least one.
  Network(std::vector<Layer> layers, Activation between);

  Eigen::Index inputs() const { return layers_.front().weight.cols(); }
  Eigen::Index outputs() const { return layers_.back().weight.rows(); }

  // Computes the outputs of `input`, which has inputs() values. The result is valid until the next
  // call. Allocates nothing.
  const Eigen::VectorXf& Run(const Eigen::VectorXf& input);

 private:
  std::vector<Layer> layers_;
  std::vector<Eigen::VectorXf> outputs_;  // by layer
  Activation between_;
};

// Makes the network of a file: tensors [PREFIX]N.weight and [PREFIX]N.bias in ascending N, and the
// word of its activation under `activation` of the metadata. `name` begins each error. Throws
// ConfigError for other tensors, widths that do not fit and numbers that are not finite.
Network MakeNetwork(const TensorFile& file, const std::string& name);

// Returns the words of activations, in the order of the enum.
const std::vector<std::string>& ActivationWords();

}  // namespace understudy::policy
