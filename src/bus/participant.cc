#include "bus/participant.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include <dds/dds.h>

#include "base/errors.h"

namespace understudy::bus {
namespace {

// Keeps the last line that Cyclone would have printed, instead of printing it, for as long as it
// lives. Of its warnings at start, "not multicast-capable" is told by Participant::multicast().
class CycloneLog {
 public:
  CycloneLog() { dds_set_log_sink(&Keep, this); }
  ~CycloneLog() { dds_set_log_sink(nullptr, nullptr); }
  CycloneLog(const CycloneLog&) = delete;
  CycloneLog& operator=(const CycloneLog&) = delete;

  std::string_view last() const { return {last_.data(), size_}; }

 private:
  static void Keep(void* self, const dds_log_data_t* line) {
    auto& log = *static_cast<CycloneLog*>(self);
    std::string_view text(line->message);
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    log.size_ = text.copy(log.last_.data(), log.last_.size());
  }

  std::array<char, 256> last_{};
  std::size_t size_ = 0;
};

Entity CreateDomain(const std::string& interface, int domain) {
  if (domain < 0 || domain > kLastDomain) {
    throw BusError("DDS domain " + std::to_string(domain) + " is out of range: 0.." +
                   std::to_string(kLastDomain));
  }
  const std::string xml =
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"" + interface +
      "\" priority=\"default\" "
      "multicast=\"default\"/></Interfaces></General></Domain></CycloneDDS>";
  const CycloneLog log;
  const dds_entity_t created = dds_create_domain(static_cast<dds_domainid_t>(domain), xml.c_str());
  const std::string where = "DDS domain " + std::to_string(domain) + " on \"" + interface + "\"";
  if (created == DDS_RETCODE_PRECONDITION_NOT_MET) {
    throw BusError("this process is in DDS domain " + std::to_string(domain) + " already");
  }
  if (created < 0 && !log.last().empty()) {
    const bool full = log.last().find("participant index") != std::string_view::npos;
    throw BusError(
        "cannot join " + where + ": " + std::string(log.last()) +
        (full ? "; without multicast an interface has room for nine programs in a domain" : ""));
  }
  return Entity(created, "join " + where);
}

}  // namespace

Participant::Participant(const std::string& interface, int domain)
    : interface_(FindInterface(interface)),
      domain_id_(domain),
      domain_(CreateDomain(interface, domain)),
      participant_(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                   "create a participant in DDS domain " + std::to_string(domain)) {
  dds_guid_t guid{};
  dds_get_guid(participant_.handle(), &guid);
  std::ranges::copy(guid.v, key_.begin());
}

}  // namespace understudy::bus
