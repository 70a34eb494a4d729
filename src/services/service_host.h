// Serves all services of a robot over DDS.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/cdr_sample.h"
#include "bus/participant.h"
#include "bus/reader.h"
#include "idl/unitree_api.h"
#include "idl/unitree_go.h"
#include "services/picture_source.h"
#include "services/request.h"
#include "services/service.h"
#include "services/service_port.h"
#include "services/status_texts.h"
#include "services/switch_topics.h"
#include "wire/outlets.h"

namespace understudy::services {

// Receives requests, answers them and sends the replies. It never blocks or throws after
// construction. The rules are the vendor's (docs/dev/sources.md#requests; the server of the Python
// SDK):
//
//   - readers of requests are best effort, writers of replies reliable, as on a robot;
//   - the request's identity is echoed, since clients match a reply by id;
//   - of the first 10 requests to a service those of priority above 0 go first. 256 more wait
//     behind; where there are more, the oldest is dropped. 8 of a service are served in a poll;
//   - a request with noreply set is carried out and not answered;
//   - while a service is not served (Service::IsServed), nobody reads its requests, so that clients
//     cannot send any (3102). Its readers go and come within a few polls, one channel in each; what
//     arrives before is dropped;
//   - a service with the fault `off` is sent requests and answers none (3104);
//   - Poll returns all that is dropped or refused;
//   - a reply waits until a response reader of the asking participant is matched, 300 ms at most:
//     response readers are volatile, and ROS 2 clients make theirs with each call. The oldest
//     waiting reply is given up when 64 wait;
//   - a reply with a picture waits for it, 10 s at most; requests go on being served meanwhile;
//   - each service has a lease, asked for on <service>_lease.
//
// A poll does a bounded amount of work, so that no tick is late however much comes: kMostWork and
// one request more; the rest waits for the next poll. The work of a request or reply is a figure of
// its own that follows from its bytes, not a time that is measured, so that equal requests at equal
// steps have equal effects on any machine and at any speed.
class ServiceHost final : public ServicePort {
 public:
  // Receives lines for the log, at most one a second per api.
  using Log = std::function<void(const std::string& notice)>;

  // Publishes through `outlets`, to which it adds wire::ServiceTopics. Throws BusError, and
  // ConfigError for an unknown text. `participant` and `outlets` must outlive the host.
  ServiceHost(const bus::Participant& participant, wire::Outlets* outlets,
              std::vector<ServiceTable> tables, Log log,
              const std::vector<std::string>& status_texts = {});

  // Allocates only if there is a request or a waiting reply. While there is none it only loads a
  // flag; what was lost or did not decode is reported within kPollsPerCount polls.
  std::span<const Call> Poll(authority::MotorOwner* owner, WallTime now) noexcept override;
  std::optional<Call> Answer(std::string_view service, std::int64_t api_id,
                             std::string_view parameter, authority::MotorOwner* owner,
                             WallTime now) noexcept override;
  void Tell(const authority::MotorOwner& owner, double t) noexcept override;
  void CountUnmatched() override { ++Refused(CallRefusal::kUnmatched); }
  std::vector<std::string> names() const override;
  std::vector<std::string> topics() const override { return topics_; }
  void ApplyFaults(std::span<const robot::ServiceEffects> faults) noexcept override;

  ServiceCounts counts() const override { return counts_; }

  // Gives pictures from then on; `source` must outlive the last Poll. Before, there are none.
  void Attach(PictureSource* source) { pictures_ = source; }

  // Returns the readers of requests, which live as long as the host.
  std::vector<const bus::ReaderCore*> readers() const;

 private:
  // The nanoseconds that work takes on the machine of docs/dev/performance.md, where they were
  // measured and rounded up.
  using Work = std::int64_t;

  struct Request {
    bus::CdrSample sample;  // has the bytes of the parameter
    RequestView view;
    std::optional<bus::ParticipantKey> client;  // nullopt if its writer has gone
  };
  using Responses = wire::Outlet<unitree_api_msg_dds__Response_>;
  struct Pending {
    bus::ParticipantKey client;
    unitree_api_msg_dds__ResponseHeader_ header;
    std::string data;
    PictureSource::Order order = 0;                 // of a picture that it waits for; 0: none
    Call call;                                      // to report when the picture is there
    PictureBytes picture;                           // null: none
    bool (*once)(const robot::MotionState& state);  // null: no condition
    WallTime not_before;
    WallTime give_up;
  };
  struct Channel {
    Channel(const bus::Participant& participant, const std::string& name, Service* of, bool leases,
            std::atomic<bool>* mail, Responses* outlet);

    std::string name;
    Service* service;
    bool is_lease;
    bus::RawReader<unitree_api_msg_dds__Request_> reader;
    Responses* responses;
    std::uint64_t undecoded = 0, lost = 0;  // of the reader, told so far
    std::deque<Request> waiting;
    std::deque<Pending> pending;
  };

  static Work WorkOf(const Request& request);
  static Work WorkOfReply(const Channel& channel);
  std::uint64_t& Refused(CallRefusal refusal) {
    return counts_.refused[static_cast<std::size_t>(refusal)];
  }
  // Closes or opens the reader of one channel whose service has stopped or started.
  void FollowPrograms(const authority::MotorOwner& owner);
  bool IsServed(const Service& service, const authority::MotorOwner& owner) const {
    return service.IsServed(owner) && !FaultOf(service).absent;
  }
  void PollChannel(Channel* channel, authority::MotorOwner* owner, WallTime now, Work* work);
  void Receive(Channel* channel);
  // Hands pictures that are done to the replies that wait for them.
  void TakePictures(WallTime now);
  // Counts calls without effect and adds them to calls_.
  void Tell(const Call& call);
  void Serve(Channel* channel, const Request& request, authority::MotorOwner* owner, WallTime now,
             Work* work);
  ServiceReply CarryOut(Service* service, const ServiceRequest& request,
                        authority::MotorOwner* owner, WallTime now);
  void Announce(ConfigChange change);
  void SendPending(Channel* channel, const authority::MotorOwner& owner, WallTime now, Work* work);
  bool Settle(Channel* channel, Pending* pending, const robot::MotionState& state, WallTime now);
  void Say(const Service& service, std::int64_t api_id, const std::string& notice, WallTime now);

  const robot::ServiceEffects& FaultOf(const Service& service) const;

  bool Idle();

  std::atomic<bool> mail_{false};  // something has arrived since the last poll
  int idle_polls_ = 0;             // since the channels were last looked at
  bool waits_ = false;             // a request or a reply, after the last poll
  std::vector<std::unique_ptr<Service>> services_;
  std::vector<robot::ServiceEffects> faults_;  // by services_
  std::vector<std::unique_ptr<Channel>> channels_;
  std::optional<SwitchTopics> switches_;  // for robots that have them
  wire::Outlet<unitree_go_msg_dds__ConfigChangeStatus_>* config_changes_ = nullptr;  // null: none
  std::vector<std::string> topics_;
  PictureSource* pictures_ = nullptr;  // null: none
  std::optional<StatusTexts> texts_;   // made once services_ are
  Log log_;
  std::map<std::pair<const Service*, std::int64_t>, WallTime> said_;
  std::size_t first_ = 0;    // the channel that the next poll begins with
  std::vector<Call> calls_;  // of the last poll
  ServiceCounts counts_;
};

}  // namespace understudy::services
