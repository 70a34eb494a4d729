// Makes files of policies for tests.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "policy/network.h"
#include "policy/tensors.h"

namespace understudy::policy {

// The bytes of a safetensors file.
std::string TensorBytes(const TensorFile& file);
// The same of a header and data as they are.
std::string RawBytes(const std::string& header, const std::string& data);

// The file of a network; `activation` is the word of its metadata.
TensorFile FileOf(const std::vector<Layer>& layers, const std::string& activation);

// The YAML list of as many equal numbers.
std::string Repeated(std::size_t count, const std::string& number);

}  // namespace understudy::policy
