#include "mjcf/saved_model.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "base/temporary_folder.h"
#include "mjcf/document.h"

namespace understudy::mjcf {
namespace {

void Append(const void* values, std::size_t size, std::string* bytes) {
  const auto* const begin = static_cast<const char*>(values);
  bytes->append(begin, begin + size);
}

SavedField FieldOf(const mjModel& model, const std::string& name) {
  const int field = mj_name2id(&model, mjOBJ_HFIELD, name.c_str());
  if (field < 0) throw ModelError("the model has no height field '" + name + "'");
  SavedField saved{.file = name + ".hf", .bytes = {}};
  const std::array<std::int32_t, 2> size{model.hfield_nrow[field], model.hfield_ncol[field]};
  Append(size.data(), sizeof(size), &saved.bytes);
  const std::size_t heights =
      static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * sizeof(float);
  Append(model.hfield_data + model.hfield_adr[field], heights, &saved.bytes);
  return saved;
}

void Clean(const mjModel& model, const std::string& clamp, MjcfElement* parent,
           std::vector<SavedField>* fields) {
  std::erase_if(parent->children, [&](const MjcfElement& child) {
    return child.name == "size" || (child.name == "weld" && child.Get("name") == clamp);
  });
  for (MjcfElement& child : parent->children) {
    if (child.name == "flag") {
      child.Drop("actuation");
      child.Drop("sensor");
    } else if (child.name == "hfield") {
      for (const char* attribute : {"nrow", "ncol"}) child.Drop(attribute);
      fields->push_back(FieldOf(model, child.Get("name")));
      child.Set("file", fields->back().file);
    }
    Clean(model, clamp, &child, fields);
  }
}

}  // namespace

SavedModel SaveModel(const mjModel& model, const std::string& clamp) {
  const TemporaryFolder folder("mjcf");
  const std::string file = folder.path() / "model.xml";
  std::array<char, 1000> error{};
  if (mj_saveLastXML(file.c_str(), &model, error.data(), static_cast<int>(error.size())) == 0) {
    throw ModelError("MuJoCo cannot write this model: " + std::string(error.data()));
  }
  MjcfElement root = ReadXml(file);
  SavedModel saved;
  Clean(model, clamp, &root, &saved.fields);
  saved.xml = WriteMjcf(root).xml;
  return saved;
}

}  // namespace understudy::mjcf
