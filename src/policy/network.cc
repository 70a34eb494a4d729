#include "policy/network.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::policy {
namespace {

void Apply(Activation activation, Eigen::VectorXf* x) {
  switch (activation) {
    case Activation::kNone:
      break;
    case Activation::kElu:
      for (float& value : *x) value = value > 0 ? value : std::expm1(value);
      break;
    case Activation::kRelu:
      for (float& value : *x) value = std::max(value, 0.0F);
      break;
    case Activation::kTanh:
      for (float& value : *x) value = std::tanh(value);
      break;
  }
}

// A tensor's name in parts: "actor.2.weight" as "actor.", 2, "weight".
struct TensorName {
  std::string prefix;
  int layer = 0;
  std::string part;
};

std::optional<TensorName> Split(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  TensorName split{.prefix = {}, .layer = 0, .part = name.substr(dot + 1)};
  const std::size_t before = name.rfind('.', dot == 0 ? 0 : dot - 1);
  const std::size_t begin = before == std::string::npos || before == dot ? 0 : before + 1;
  split.prefix = name.substr(0, begin);
  const char* const end = name.data() + dot;
  const auto [parsed, error] = std::from_chars(name.data() + begin, end, split.layer);
  const bool known = split.part == "weight" || split.part == "bias";
  if (error != std::errc() || parsed != end || split.layer < 0 || !known) return std::nullopt;
  return split;
}

std::string Text(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t size : shape) text += (text.empty() ? "" : ", ") + std::to_string(size);
  return "[" + text + "]";
}

Activation ActivationOf(const TensorFile& file, const std::string& name) {
  const auto found = file.metadata.find("activation");
  const std::string word = found == file.metadata.end() ? "" : found->second;
  const std::vector<std::string>& words = ActivationWords();
  const auto known = std::ranges::find(words, word);
  if (known == words.end()) {
    throw ConfigError(name + ": __metadata__.activation: " +
                      (word.empty() ? "missing" : "no activation '" + word + "'") +
                      DidYouMean(word, words));
  }
  return static_cast<Activation>(known - words.begin());
}

Layer LayerOf(const std::string& at, const Tensor& weight, const Tensor* bias, std::size_t inputs) {
  const auto fail = [&](const std::string& part, const std::string& what) {
    throw ConfigError(at + part + ": " + what);
  };
  if (weight.shape.size() != 2 || weight.values.empty()) {
    fail("weight", "expected the shape [outputs, inputs], got " + Text(weight.shape));
  }
  if (inputs != 0 && weight.shape[1] != inputs) {
    fail("weight", "expected " + std::to_string(inputs) +
                       " inputs, as the previous layer has outputs, got " + Text(weight.shape));
  }
  const std::size_t outputs = weight.shape[0];
  if (bias == nullptr) fail("bias", "missing");
  if (bias->shape != std::vector{outputs}) {
    fail("bias", "expected the shape " + Text({outputs}) + ", got " + Text(bias->shape));
  }
  const auto finite = [](float x) { return std::isfinite(x); };
  if (!std::ranges::all_of(weight.values, finite)) fail("weight", "expected finite numbers");
  if (!std::ranges::all_of(bias->values, finite)) fail("bias", "expected finite numbers");
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(outputs);
  return {.weight = Eigen::Map<const RowMajor>(weight.values.data(), rows,
                                               static_cast<Eigen::Index>(weight.shape[1])),
          .bias = Eigen::Map<const Eigen::VectorXf>(bias->values.data(), rows)};
}

}  // namespace

const std::vector<std::string>& ActivationWords() {
  static const std::vector<std::string> kWords{"none", "elu", "relu", "tanh"};
  return kWords;
}

Network::Network(std::vector<Layer> layers, Activation between)
    : layers_(std::move(layers)), between_(between) {
  for (const Layer& layer : layers_) outputs_.emplace_back(layer.bias);
}

const Eigen::VectorXf& Network::Run(const Eigen::VectorXf& input) {
  const Eigen::VectorXf* x = &input;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    Eigen::VectorXf& y = outputs_[i];
    y = layers_[i].bias;
    y.noalias() += layers_[i].weight * *x;
    if (i + 1 < layers_.size()) Apply(between_, &y);
    x = &y;
  }
  return outputs_.back();
}

Network MakeNetwork(const TensorFile& file, const std::string& name) {
  std::map<int, const Tensor*> weights, biases;
  std::optional<std::string> prefix;
  for (const auto& [key, tensor] : file.tensors) {
    const auto split = Split(key);
    if (!split || (prefix && *prefix != split->prefix)) {
      throw ConfigError(name + ": " + key +
                        ": expected one network, of tensors N.weight and N.bias");
    }
    prefix = split->prefix;
    (split->part == "weight" ? weights : biases)[split->layer] = &tensor;
  }
  if (weights.empty()) throw ConfigError(name + ": expected layers N.weight and N.bias, got none");
  std::vector<Layer> layers;
  std::size_t inputs = 0;
  for (const auto& [number, weight] : weights) {
    const auto bias = biases.extract(number);
    const std::string at = name + ": " + *prefix + std::to_string(number) + ".";
    layers.push_back(LayerOf(at, *weight, bias.empty() ? nullptr : bias.mapped(), inputs));
    inputs = weight->shape[0];
  }
  if (!biases.empty()) {
    throw ConfigError(name + ": " + *prefix + std::to_string(biases.begin()->first) +
                      ".weight: missing");
  }
  return {std::move(layers), ActivationOf(file, name)};
}

}  // namespace understudy::policy
