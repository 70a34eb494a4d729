// Serves all services of a robot over DDS.
#pragma once

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

#include "bus/participant.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/std_msgs.h"
#include "idl/unitree_api.h"
#include "idl/unitree_go.h"
#include "services/service.h"
#include "services/service_port.h"
#include "services/status_texts.h"

namespace understudy::services {

// Settings of a Go2 that a message changes instead of a request (docs/sources.md#topics):
//   rt/utlidar/switch  String_ "ON" or "OFF": the program unitree_lidar. That robot_state then
//                      lists it so is assumed; no lidar is modelled.
//   rt/uwbswitch       UwbSwitch_: what uwbswitch SwitchSet sets.
class SwitchTopics {
 public:
  // Throws BusError. `uwb_switch` must outlive this.
  SwitchTopics(const bus::Participant& participant, Service* uwb_switch);

  // Takes the waiting messages. Words other than ON and OFF change nothing.
  void Poll(authority::MotorOwner* owner);

 private:
  Service* uwb_switch_;
  bus::Reader<std_msgs_msg_dds__String_> lidar_;
  bus::Reader<unitree_go_msg_dds__UwbSwitch_> uwb_;
};

// Receives requests, answers them and sends the replies. It never blocks or throws after
// construction. The rules are the vendor's (docs/sources.md#requests; the server of the Python
// SDK):
//
//   - readers of requests are best effort, writers of replies reliable, as on a robot;
//   - the request's identity is echoed, since clients match a reply by id;
//   - requests of priority above 0 go first. Of each service 10 requests and 5 of priority wait in
//     queues, 256 more in the reader; where there are more, the oldest is dropped. 8 are served in
//     a poll;
//   - a request with noreply set is carried out and not answered;
//   - while a service is not served (Service::IsServed), what comes for it is dropped;
//   - a reply waits until a response reader of the asking participant is matched, 300 ms at most:
//     response readers are volatile, and ROS 2 clients make theirs with each call. The oldest
//     waiting reply is given up when 64 wait;
//   - each service has a lease, asked for on <service>_lease.
class ServiceHost final : public ServicePort {
 public:
  // Receives lines for the log, at most one a second per api.
  using Say = std::function<void(const std::string& notice)>;

  // `status_texts` are topics as for StatusTexts. Throws BusError, and ConfigError for an unknown
  // one. `participant` must outlive the host.
  ServiceHost(const bus::Participant& participant, std::vector<ServiceTable> tables, Say say,
              const std::vector<std::string>& status_texts = {});

  // Allocates only if there is a request or a waiting reply.
  std::span<const Call> Poll(authority::MotorOwner* owner, WallTime now) noexcept override;
  std::optional<std::int32_t> Answer(std::string_view service, std::int64_t api_id,
                                     std::string_view parameter, authority::MotorOwner* owner,
                                     WallTime now) noexcept override;
  void Tell(const authority::MotorOwner& owner, double t) noexcept override;

  ServiceCounts counts() const override { return counts_; }

 private:
  struct Request {
    std::int64_t id, api_id, lease_id;
    bool noreply;
    std::string parameter;  // empty if it was too long
    std::size_t parameter_bytes, binary_bytes;
    std::optional<bus::ParticipantKey> client;  // nullopt if its writer has gone
  };
  struct Pending {
    bus::ParticipantKey client;
    unitree_api_msg_dds__ResponseHeader_ header;
    std::string data;
    bool (*once)(const robot::MotionState& state);  // null: no condition
    WallTime give_up;
  };
  struct Channel {
    Channel(const bus::Participant& participant, const std::string& name, Service* of, bool leases);

    Service* service;
    bool is_lease;
    std::string request_topic, response_topic;
    bus::Reader<unitree_api_msg_dds__Request_> reader;
    bus::Writer<unitree_api_msg_dds__Response_> writer;
    std::deque<Request> normal, urgent;
    std::deque<Pending> pending;
  };

  void Receive(Channel* channel);
  void Serve(Channel* channel, const Request& request, authority::MotorOwner* owner, WallTime now);
  ServiceReply CarryOut(Service* service, const ServiceRequest& request,
                        authority::MotorOwner* owner, WallTime now);
  void Announce(ConfigChange change);
  void SendPending(Channel* channel, const authority::MotorOwner& owner, WallTime now);
  void Tell(const Service& service, std::int64_t api_id, const std::string& notice, WallTime now);

  std::vector<std::unique_ptr<Service>> services_;
  std::vector<std::unique_ptr<Channel>> channels_;
  std::optional<SwitchTopics> switches_;  // for robots that have them
  std::optional<bus::Writer<unitree_go_msg_dds__ConfigChangeStatus_>> config_changes_;
  std::optional<StatusTexts> texts_;  // made once services_ are
  Say say_;
  std::map<std::pair<const Service*, std::int64_t>, WallTime> told_;
  std::vector<Call> calls_;  // carried out in the last poll
  ServiceCounts counts_;
};

}  // namespace understudy::services
