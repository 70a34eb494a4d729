#include "tests/policy/files.h"

#include <cstdint>
#include <cstring>

namespace understudy::policy {

std::string RawBytes(const std::string& header, const std::string& data) {
  std::string bytes(8, '\0');
  const std::uint64_t length = header.size();
  std::memcpy(bytes.data(), &length, bytes.size());
  return bytes + header + data;
}

std::string TensorBytes(const TensorFile& file) {
  std::string header, data, metadata;
  for (const auto& [key, value] : file.metadata) {
    metadata += (metadata.empty() ? "\"" : ",\"") + key + "\":\"" + value + "\"";
  }
  header = "{\"__metadata__\":{" + metadata + "}";
  for (const auto& [name, tensor] : file.tensors) {
    std::string shape;
    for (const std::size_t size : tensor.shape) {
      shape += (shape.empty() ? "" : ",") + std::to_string(size);
    }
    const std::size_t bytes = tensor.values.size() * sizeof(float);
    header += ",\"" + name + "\":{\"dtype\":\"F32\",\"shape\":[" + shape + "],\"data_offsets\":[" +
              std::to_string(data.size()) + "," + std::to_string(data.size() + bytes) + "]}";
    data.append(reinterpret_cast<const char*>(tensor.values.data()), bytes);
  }
  return RawBytes(header + "}", data);
}

TensorFile FileOf(const std::vector<Layer>& layers, const std::string& activation) {
  TensorFile file{.tensors = {}, .metadata = {{"activation", activation}}};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const Layer& layer = layers[i];
    const std::string name = std::to_string(2 * i);
    Tensor weight{.shape = {static_cast<std::size_t>(layer.weight.rows()),
                            static_cast<std::size_t>(layer.weight.cols())},
                  .values = {}};
    for (const auto& row : layer.weight.rowwise()) {
      weight.values.insert(weight.values.end(), row.begin(), row.end());
    }
    file.tensors[name + ".weight"] = weight;
    file.tensors[name + ".bias"] = {.shape = {weight.shape[0]},
                                    .values = {layer.bias.begin(), layer.bias.end()}};
  }
  return file;
}

std::string Repeated(std::size_t count, const std::string& number) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + number;
  return "[" + text + "]";
}

}  // namespace understudy::policy
