#include "bus/participant.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include <dds/dds.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "base/errors.h"
#include "bus/cyclone_log.h"
#include "bus/foreign_types.h"
#include "bus/qos.h"

namespace understudy::bus {
namespace {

// Cyclone 0.10.2 ends the process, by a signal and without a word, where it gets no descriptor for
// a socket or no memory for a thread. What it takes of both was measured: 11 descriptors on one
// interface, 50 MB of addresses, most of them for the stacks of its threads.
void RefuseWithoutRoom(const std::string& where) {
  constexpr rlim_t kDescriptors = 16;
  constexpr std::size_t kBytes = std::size_t{64} << 20U;
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur != RLIM_INFINITY) {
    rlim_t open = 0;
    for (rlim_t fd = 0; fd < std::min<rlim_t>(files.rlim_cur, 1024); ++fd) {
      if (::fcntl(static_cast<int>(fd), F_GETFD) >= 0) ++open;
    }
    if (files.rlim_cur < open + kDescriptors) {
      throw BusError("cannot join " + where + ": of " + std::to_string(files.rlim_cur) +
                     " files that this process may open (ulimit -n) " + std::to_string(open) +
                     " are, and it takes " + std::to_string(kDescriptors) + " more");
    }
  }
  void* const room = ::mmap(nullptr, kBytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) {
    throw BusError("cannot join " + where +
                   ": it takes 64 MB of memory, more than this process may "
                   "have (ulimit -v)");
  }
  ::munmap(room, kBytes);
}

Domain CreateDomain(const std::string& interface, int domain) {
  if (domain < 0 || domain > kLastDomain) {
    throw BusError("DDS domain " + std::to_string(domain) + " is out of range: 0.." +
                   std::to_string(kLastDomain));
  }
  const std::string xml =
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"" + interface +
      "\" priority=\"default\" "
      "multicast=\"default\"/></Interfaces></General></Domain></CycloneDDS>";
  const std::string where = "DDS domain " + std::to_string(domain) + " on \"" + interface + "\"";
  RequireUnreadTypes();
  RefuseWithoutRoom(where);
  TakeCycloneNotices();
  const dds_entity_t created = dds_create_domain(static_cast<dds_domainid_t>(domain), xml.c_str());
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
        (full ? "; without multicast an interface has room for nine programs in a domain: use "
                "`understudy exec`, another domain or, as root, `ip link set " +
                    interface + " multicast on`"
              : ""));
  }
  return Domain(Entity(created, "join " + where));
}

QosPtr ParticipantQos(const std::string& announcement) {
  QosPtr qos(dds_create_qos());
  if (!announcement.empty()) {
    dds_qset_userdata(qos.get(), announcement.data(), announcement.size());
  }
  return qos;
}

}  // namespace

Domain::~Domain() {
  constexpr std::chrono::seconds kMostEnding(5);  // *assumed*: it takes milliseconds
  if (domain_.handle() == 0) return;
  std::promise<void> promise;
  const std::future<void> ended = promise.get_future();
  try {
    std::thread thread([domain = std::move(domain_), promise = std::move(promise)]() mutable {
      { const Entity gone = std::move(domain); }
      promise.set_value();
    });
    if (ended.wait_for(kMostEnding) == std::future_status::ready) {
      thread.join();
    } else {
      thread.detach();
    }
  } catch (const std::system_error&) {  // there is no thread to be had: it was ended here
  }
}

Participant::Participant(const std::string& interface, int domain, const std::string& announcement)
    : interface_(FindInterface(interface)),
      domain_id_(domain),
      announcement_(announcement),
      domain_(CreateDomain(interface, domain)),
      participant_(dds_create_participant(static_cast<dds_domainid_t>(domain),
                                          ParticipantQos(announcement).get(), nullptr),
                   "create a participant in DDS domain " + std::to_string(domain)) {
  dds_guid_t guid{};
  dds_get_guid(participant_.handle(), &guid);
  std::ranges::copy(guid.v, key_.begin());
}

std::optional<ParticipantKey> ParticipantOf(const Entity& reader, std::uint64_t writer) {
  const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>
      endpoint(dds_get_matched_publication_data(reader.handle(), writer),
               &dds_builtintopic_free_endpoint);
  if (endpoint == nullptr) return std::nullopt;
  return std::to_array(endpoint->participant_key.v);
}

}  // namespace understudy::bus
