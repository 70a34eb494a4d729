#include "bus/foreign_types.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>
#include <dds/ddsi/ddsi_serdata_default.h>
#include <dds/ddsi/ddsi_xqos.h>
// After ddsi_xqos.h, whose types they take for granted.
#include <dds/ddsi/ddsi_typelookup.h>
#include <dds/ddsi/ddsi_xt_impl.h>
#include <dlfcn.h>
#include <link.h>

#include "base/errors.h"

namespace {

// The most bytes that are read of an endpoint's type information and of a question about types.
// Both nest, and Cyclone follows them by recursion: 120 kB overflow the stack (measured).
// *Assumed*: a question about a hundred types has 3 kB.
constexpr std::uint32_t kMostBytes = 8192;

constexpr std::string_view kQuestions = "DDS::Builtin::TypeLookup_Request";
constexpr std::string_view kAnswers = "DDS::Builtin::TypeLookup_Reply";

// Returns Cyclone's own function of that name, which the one here takes the place of.
template <typename Function>
Function* Cyclones(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// Functions of Cyclone's, which calls them by name: the dynamic linker finds a program's own before
// a library's. A Cyclone that was linked to call its own, with -Bsymbolic-functions, does not.

// NOLINTBEGIN(readability-identifier-naming): Cyclone's names
extern "C" {

bool ddsi_tl_request_type(ddsi_domaingv*, const ddsi_typeid_t*, const ddsi_guid_t*,
                          ddsi_type_include_deps_t) {
  return false;  // nobody was asked
}

void ddsi_tl_handle_reply(ddsi_domaingv*, ddsi_serdata*) {}

// Called for each foreign endpoint that discovery finds with type information. Sets `type` to
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
  static auto* const cyclones = Cyclones<decltype(ddsi_type_ref_proxy)>("ddsi_type_ref_proxy");
  return cyclones(domain, type, &hashes, kind, endpoint);
}

// Checks a message of any topic before anything reads it.
bool dds_stream_normalize(void* data, std::uint32_t size, bool bswap, std::uint32_t version,
                          const ddsi_sertype_default* type, bool just_key, std::uint32_t* used) {
  if (type->c.type_name == kQuestions && size > kMostBytes) return false;
  if (type->c.type_name == kAnswers) {  // nothing reads them
    *used = size;
    return true;
  }
  static auto* const cyclones = Cyclones<decltype(dds_stream_normalize)>("dds_stream_normalize");
  return cyclones(data, size, bswap, version, type, just_key, used);
}

// Checks, among others, an endpoint's type information.
const std::uint32_t* dds_stream_normalize_data(char* data, std::uint32_t* offset,
                                               std::uint32_t size, bool bswap,
                                               std::uint32_t version, const std::uint32_t* ops) {
  if (ops == DDS_XTypes_TypeInformation_desc.m_ops && size > kMostBytes) return nullptr;
  static auto* const cyclones =
      Cyclones<decltype(dds_stream_normalize_data)>("dds_stream_normalize_data");
  return cyclones(data, offset, size, bswap, version, ops);
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming)

namespace understudy::bus {
namespace {

struct Replaced {
  const char* name;
  void* ours;
};

const Replaced kReplaced[] = {
    {"ddsi_tl_request_type", reinterpret_cast<void*>(&ddsi_tl_request_type)},
    {"ddsi_tl_handle_reply", reinterpret_cast<void*>(&ddsi_tl_handle_reply)},
    {"ddsi_type_ref_proxy", reinterpret_cast<void*>(&ddsi_type_ref_proxy)},
    {"dds_stream_normalize", reinterpret_cast<void*>(&dds_stream_normalize)},
    {"dds_stream_normalize_data", reinterpret_cast<void*>(&dds_stream_normalize_data)},
};

// The parts of a loaded library that tell which functions it calls by name.
struct Calls {
  const ElfW(Sym) * symbols = nullptr;
  const char* names = nullptr;
  const ElfW(Rela) * first = nullptr;
  std::size_t bytes = 0;
};

// NOLINTBEGIN(performance-no-int-to-ptr): a library's tables hold addresses as numbers
Calls CallsOf(const dl_phdr_info& library) {
  Calls calls;
  for (const ElfW(Phdr) & part : std::span(library.dlpi_phdr, library.dlpi_phnum)) {
    if (part.p_type != PT_DYNAMIC) continue;
    const auto* entry = reinterpret_cast<const ElfW(Dyn)*>(library.dlpi_addr + part.p_vaddr);
    for (; entry->d_tag != DT_NULL; ++entry) {
      switch (entry->d_tag) {
        case DT_SYMTAB:
          calls.symbols = reinterpret_cast<const ElfW(Sym)*>(entry->d_un.d_ptr);
          break;
        case DT_STRTAB:
          calls.names = reinterpret_cast<const char*>(entry->d_un.d_ptr);
          break;
        case DT_JMPREL:
          calls.first = reinterpret_cast<const ElfW(Rela)*>(entry->d_un.d_ptr);
          break;
        case DT_PLTRELSZ:
          calls.bytes = entry->d_un.d_val;
          break;
        default:
          break;
      }
    }
  }
  return calls;
}
// NOLINTEND(performance-no-int-to-ptr)

int FindCall(dl_phdr_info* library, std::size_t, void* wanted) {
  if (std::string_view(library->dlpi_name).find("/libddsc.") == std::string_view::npos) return 0;
  const Calls calls = CallsOf(*library);
  for (const ElfW(Rela) & call : std::span(calls.first, calls.bytes / sizeof(ElfW(Rela)))) {
    const ElfW(Sym)& symbol = calls.symbols[ELF64_R_SYM(call.r_info)];
    if (*static_cast<std::string_view*>(wanted) == calls.names + symbol.st_name) return 1;
  }
  return 0;
}

}  // namespace

bool CycloneCalls(std::string_view function) { return dl_iterate_phdr(&FindCall, &function) != 0; }

bool ReadsForeignTypes() { return !std::ranges::all_of(kReplaced, CycloneCalls, &Replaced::name); }

void RequireUnreadTypes() {
  const auto is_ours = [](const Replaced& one) {
    return ::dlsym(RTLD_DEFAULT, one.name) == one.ours;
  };
  if (std::ranges::all_of(kReplaced, is_ours)) return;
  throw BusError(
      "this build lets Cyclone DDS read foreign type information, which may crash it: link it with "
      "--export-dynamic");
}

}  // namespace understudy::bus
