#include "policy/network.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/policy/files.h"

namespace understudy::policy {
namespace {

using ::testing::HasSubstr;

// Two inputs, two hidden values, one output; whole numbers, so that no order of sums matters.
std::vector<Layer> TwoLayers() {
  Layer hidden{.weight = Eigen::MatrixXf(2, 2), .bias = Eigen::VectorXf(2)};
  hidden.weight << 1, 2, 3, -4;
  hidden.bias << 1, 0;
  Layer last{.weight = Eigen::MatrixXf(1, 2), .bias = Eigen::VectorXf(1)};
  last.weight << 2, 8;
  last.bias << 5;
  return {hidden, last};
}

std::string WhyNot(const TensorFile& file) {
  try {
    MakeNetwork(file, "walk.safetensors");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(NetworkTest, ComputesItsLayersWithTheActivationBetweenThem) {
  const Eigen::Vector2f input(1, 2);  // hidden: 1 + 4 + 1 = 6 and 3 - 8 = -5
  const std::pair<const char*, float> rows[] = {
      {"none", 12 - 40 + 5},
      {"relu", 12 + 5},
      {"elu", 2 * 6 + 8 * std::expm1(-5.0F) + 5},
      {"tanh", 2 * std::tanh(6.0F) + 8 * std::tanh(-5.0F) + 5},
  };
  for (const auto& [activation, output] : rows) {
    Network network = MakeNetwork(FileOf(TwoLayers(), activation), "walk.safetensors");
    EXPECT_EQ(network.inputs(), 2);
    EXPECT_EQ(network.outputs(), 1);
    EXPECT_FLOAT_EQ(network.Run(input)[0], output) << activation;
  }
}

TEST(NetworkTest, ReadsLayersInTheOrderOfTheirNumbersUnderAnyPrefix) {
  const TensorFile made = FileOf(TwoLayers(), "none");
  TensorFile named{.tensors = {}, .metadata = made.metadata};
  for (const auto& [from, to] : {std::pair{"0.", "actor.9."}, std::pair{"2.", "actor.11."}}) {
    for (const std::string part : {"weight", "bias"}) {
      named.tensors[to + part] = made.tensors.at(from + part);
    }
  }
  EXPECT_EQ(MakeNetwork(named, "").Run(Eigen::Vector2f(1, 2))[0], -23);
}

TEST(NetworkTest, RefusesWhatIsNoNetworkAndSaysWhy) {
  const auto changed = [](const auto& change) {
    TensorFile file = FileOf(TwoLayers(), "elu");
    change(&file);
    return WhyNot(file);
  };
  EXPECT_THAT(changed([](TensorFile* f) { f->metadata.clear(); }),
              HasSubstr("__metadata__.activation: missing; valid: none, elu, relu, tanh"));
  EXPECT_THAT(changed([](TensorFile* f) { f->metadata["activation"] = "rely"; }),
              HasSubstr("no activation 'rely'; did you mean 'relu'?"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors.erase("2.bias"); }),
              HasSubstr("walk.safetensors: 2.bias: missing"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors.erase("2.weight"); }),
              HasSubstr("2.weight: missing"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors.clear(); }), HasSubstr("got none"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors["std"] = {}; }),
              HasSubstr("std: expected one network"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors["critic.0.weight"] = {}; }),
              HasSubstr("expected one network"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors["0.weight"].shape = {4}; }),
              HasSubstr("0.weight: expected the shape [outputs, inputs], got [4]"));
  EXPECT_THAT(changed([](TensorFile* f) {
                f->tensors["2.weight"].shape = {2, 1};
              }),
              HasSubstr("2.weight: expected 2 inputs, as the previous layer has outputs"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors["0.bias"].shape = {1}; }),
              HasSubstr("0.bias: expected the shape [2], got [1]"));
  EXPECT_THAT(changed([](TensorFile* f) { f->tensors["0.weight"].values[1] = NAN; }),
              HasSubstr("0.weight: expected finite numbers"));
  for (const char* name : {"", ".", "weight", ".weight", "0.", "x.weight", "0.weight.1", "-1.bias",
                           "0..weight", "99999999999.weight"}) {
    EXPECT_THAT(changed([&](TensorFile* f) { f->tensors[name] = {}; }),
                HasSubstr("expected one network"))
        << name;
  }
}

}  // namespace
}  // namespace understudy::policy
