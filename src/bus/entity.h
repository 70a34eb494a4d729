// Owns an entity of the Cyclone DDS C API.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace understudy::bus {

// Owns one Cyclone entity. The destructor deletes it and its children; this is harmless if its
// parent was deleted before.
class Entity {
 public:
  // Takes the result of a dds_create_*(). Throws BusError "cannot <what>: <Cyclone's reason>" if
  // that is an error.
  Entity(std::int32_t created, const std::string& what);
  ~Entity();
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }

  std::int32_t handle() const { return handle_; }

 private:
  std::int32_t handle_;  // 0 once moved from
};

}  // namespace understudy::bus
