#include "bus/entity.h"

#include <type_traits>

#include <dds/dds.h>

#include "base/errors.h"

namespace understudy::bus {

static_assert(std::is_same_v<dds_entity_t, std::int32_t>);

Entity::Entity(std::int32_t created, const std::string& what) : handle_(created) {
  if (created < 0) throw BusError("cannot " + what + ": " + dds_strretcode(created));
}

Entity::~Entity() {
  if (handle_ > 0) dds_delete(handle_);
}

}  // namespace understudy::bus
