// One entity of the Cyclone DDS C API.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace understudy::bus {

// Owns one Cyclone entity and deletes it, and with it the entities created below it. Deleting after
// the parent has gone is harmless.
class Entity {
 public:
  // Takes what a dds_create_*() returned. Throws BusError "cannot <what>: <Cyclone's reason>" when
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
