#include "bus/participant.h"

#include <algorithm>
#include <vector>

#include <dds/dds.h>

#include "base/errors.h"
#include "bus/cyclone_log.h"

namespace understudy::bus {
namespace {

Entity CreateDomain(const std::string& interface, int domain) {
  if (domain < 0 || domain > kLastDomain) {
    throw BusError("DDS domain " + std::to_string(domain) + " is out of range: 0.." +
                   std::to_string(kLastDomain));
  }
  const std::string xml =
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"" + interface +
      "\" priority=\"default\" "
      "multicast=\"default\"/></Interfaces></General></Domain></CycloneDDS>";
  TakeCycloneNotices();
  const dds_entity_t created = dds_create_domain(static_cast<dds_domainid_t>(domain), xml.c_str());
  const std::string where = "DDS domain " + std::to_string(domain) + " on \"" + interface + "\"";
  if (created == DDS_RETCODE_PRECONDITION_NOT_MET) {
    throw BusError("this process is in DDS domain " + std::to_string(domain) + " already");
  }
  // Drops Cyclone's warnings of the start; multicast() replaces "not multicast-capable".
  const std::vector<CycloneNotice> said = TakeCycloneNotices();
  if (created < 0 && !said.empty()) {
    const std::string& why = said.back().line;
    const bool full = why.find("participant index") != std::string::npos;
    throw BusError(
        "cannot join " + where + ": " + why +
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
