#include "bus/foreign_types.h"

#include <cstdint>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_xqos.h>
// After ddsi_xqos.h, whose types they take for granted.
#include <dds/ddsi/ddsi_typelookup.h>
#include <dds/ddsi/ddsi_xt_impl.h>
#include <dlfcn.h>

#include "base/errors.h"

// Functions of Cyclone's, which calls them by name: the dynamic linker finds a program's own before
// a library's.

// NOLINTBEGIN(readability-identifier-naming): Cyclone's names
extern "C" {

bool ddsi_tl_request_type(ddsi_domaingv*, const ddsi_typeid_t*, const ddsi_guid_t*,
                          ddsi_type_include_deps_t) {
  return false;  // nobody was asked
}

void ddsi_tl_handle_reply(ddsi_domaingv*, ddsi_serdata*) {}

// Called for each end of another's that discovery finds and that tells of its type. Sets `type` to
// what the matching compares; null compares names alone.
dds_return_t ddsi_type_ref_proxy(ddsi_domaingv* domain, ddsi_type** type,
                                 const ddsi_typeinfo_t* told, ddsi_typeid_kind_t kind,
                                 const ddsi_guid_t* endpoint) {
  constexpr std::uint32_t kMaker =
      understudy::bus::kCyclone[0] << 8U | understudy::bus::kCyclone[1];
  if (endpoint == nullptr || endpoint->prefix.u[0] >> 16U != kMaker ||
      !ddsi_typeid_is_hash(ddsi_typeinfo_minimal_typeid(told)) ||
      !ddsi_typeid_is_hash(ddsi_typeinfo_complete_typeid(told))) {
    *type = nullptr;
    return DDS_RETCODE_OK;
  }
  // Not what it says its type is made of: Cyclone would believe that of types of ours, too.
  ddsi_typeinfo_t hashes{};
  hashes.x.minimal.typeid_with_size = told->x.minimal.typeid_with_size;
  hashes.x.complete.typeid_with_size = told->x.complete.typeid_with_size;
  static const auto cyclones =
      reinterpret_cast<decltype(&ddsi_type_ref_proxy)>(::dlsym(RTLD_NEXT, "ddsi_type_ref_proxy"));
  return cyclones(domain, type, &hashes, kind, endpoint);
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming)

namespace understudy::bus {

void RequireUnreadTypes() {
  const auto is_ours = [](const char* name, auto* ours) {
    return ::dlsym(RTLD_DEFAULT, name) == reinterpret_cast<void*>(ours);
  };
  if (is_ours("ddsi_tl_request_type", &ddsi_tl_request_type) &&
      is_ours("ddsi_tl_handle_reply", &ddsi_tl_handle_reply) &&
      is_ours("ddsi_type_ref_proxy", &ddsi_type_ref_proxy)) {
    return;
  }
  throw BusError(
      "this build lets Cyclone DDS read what others tell of their types, at which it may crash: "
      "link it with --export-dynamic");
}

}  // namespace understudy::bus
