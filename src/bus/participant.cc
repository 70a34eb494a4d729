#include "bus/participant.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <future>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include <dds/dds.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "base/errors.h"
#include "bus/cyclone_log.h"
#include "bus/foreign_types.h"
#include "bus/qos.h"

namespace understudy::bus {
namespace {

// Threads that can be started, up to `most`. They wait for each other, with small stacks.
std::size_t StartableThreads(std::size_t most) {
  constexpr std::size_t kStack = 64 << 10U;
  std::latch over(1);
  pthread_attr_t small;
  ::pthread_attr_init(&small);
  ::pthread_attr_setstacksize(&small, kStack);
  std::vector<pthread_t> threads;
  for (pthread_t thread{}; threads.size() < most; threads.push_back(thread)) {
    const auto wait = [](void* until) -> void* {
      static_cast<std::latch*>(until)->wait();
      return nullptr;
    };
    if (::pthread_create(&thread, &small, wait, &over) != 0) break;
  }
  over.count_down();
  for (const pthread_t thread : threads) ::pthread_join(thread, nullptr);
  ::pthread_attr_destroy(&small);
  return threads.size();
}

// Cyclone 0.10.2 ends the process, by a signal and without a word, where it gets no descriptor for
// a socket, no thread or no memory for one. What it takes was measured: 11 descriptors on one
// interface, 8 threads, 50 MB of addresses, most of them for the stacks of its threads.
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
  constexpr std::size_t kThreads = 16;
  if (const std::size_t had = StartableThreads(kThreads); had < kThreads) {
    throw BusError("cannot join " + where + ": it takes " + std::to_string(kThreads) +
                   " threads, and this process may start " + std::to_string(had) +
                   " more (ulimit -u, or a container's limit of processes)");
  }
}

// The last index for which the ports of the last domain fit into 16 bits, too: so many programs of
// ours have well-known ports on one interface.
constexpr int kLastIndex = 60;

Domain CreateDomain(const NetworkInterface& interface, int domain) {
  if (domain < 0 || domain > kLastDomain) {
    throw BusError("DDS domain " + std::to_string(domain) + " is out of range: 0.." +
                   std::to_string(kLastDomain));
  }
  // Cyclone numbers the domains of a process. A further one of the same domain gets another number
  // here and the domain's own on the network.
  static std::atomic<std::uint32_t> next{kLastDomain + 1};
  const auto xml = [&](bool further) {
    // By address: of an interface that has several, Cyclone would take the first.
    return "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"" +
           DdsAddress(interface) +
           "\" priority=\"default\" multicast=\"default\"/></Interfaces></General><Discovery>" +
           (interface.multicast
                ? "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
                      std::to_string(kLastIndex) + "</MaxAutoParticipantIndex>"
                : "") +
           (further ? "<ExternalDomainId>" + std::to_string(domain) + "</ExternalDomainId>" : "") +
           "</Discovery></Domain></CycloneDDS>";
  };
  const std::string where =
      "DDS domain " + std::to_string(domain) + " on \"" + interface.name + "\"";
  RequireUnreadTypes();
  RefuseWithoutRoom(where);
  TakeCycloneNotices();
  auto number = static_cast<dds_domainid_t>(domain);
  dds_entity_t created = dds_create_domain(number, xml(false).c_str());
  if (created == DDS_RETCODE_PRECONDITION_NOT_MET) {  // this process is in it already
    number = next++;
    created = dds_create_domain(number, xml(true).c_str());
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
                    interface.name + " multicast on`"
              : ""));
  }
  return {Entity(created, "join " + where), number};
}

QosPtr ParticipantQos(const std::string& announcement) {
  QosPtr qos(dds_create_qos());
  if (!announcement.empty()) {
    dds_qset_userdata(qos.get(), announcement.data(), announcement.size());
  }
  return qos;
}

QosPtr InPartition(const std::string& partition) {
  QosPtr qos(dds_create_qos());
  const char* names[] = {partition.c_str()};
  dds_qset_partition(qos.get(), 1, names);
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

Participant::Participant(const std::string& interface, int domain, const std::string& announcement,
                         const std::string& partition)
    : interface_(FindInterface(interface)),
      domain_id_(domain),
      announcement_(announcement),
      partition_(partition),
      domain_(CreateDomain(interface_, domain)),
      participant_(
          dds_create_participant(domain_.number(), ParticipantQos(announcement).get(), nullptr),
          "create a participant in DDS domain " + std::to_string(domain)) {
  dds_guid_t guid{};
  dds_get_guid(participant_.handle(), &guid);
  std::ranges::copy(guid.v, key_.begin());
  if (partition.empty()) return;
  const QosPtr qos = InPartition(partition);
  publisher_.emplace(dds_create_publisher(handle(), qos.get(), nullptr), "write in " + partition);
  subscriber_.emplace(dds_create_subscriber(handle(), qos.get(), nullptr), "read in " + partition);
}

std::optional<ParticipantKey> ParticipantOf(const Entity& reader, std::uint64_t writer) {
  const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>
      endpoint(dds_get_matched_publication_data(reader.handle(), writer),
               &dds_builtintopic_free_endpoint);
  if (endpoint == nullptr) return std::nullopt;
  return std::to_array(endpoint->participant_key.v);
}

}  // namespace understudy::bus
