// Reads files of tensors in the format safetensors (docs/reference/policies.md#weights).
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::policy {

struct Tensor {
  std::vector<std::size_t> shape;
  std::vector<float> values;  // row-major
};

struct TensorFile {
  std::map<std::string, Tensor> tensors;
  std::map<std::string, std::string> metadata;  // entries of __metadata__
};

// Parses the bytes of a file with tensors of float32; `name` begins each error. The tensors
// together are no larger than the bytes. Throws ConfigError for every fault of form: lengths,
// offsets and shapes that do not fit, a header of more than 1 MiB, another type than F32.
TensorFile ParseTensors(std::string_view bytes, const std::string& name);

// Parses a file of at most 256 MiB. Throws ConfigError also if it cannot be read.
TensorFile ReadTensors(const std::filesystem::path& file);

}  // namespace understudy::policy
