// Serves requests over DDS: one host for all services of a robot.
#ifndef UNDERSTUDY_SERVICES_SERVICE_HOST_H_
#define UNDERSTUDY_SERVICES_SERVICE_HOST_H_

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "bus/participant.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/unitree_api.h"
#include "services/service.h"

namespace understudy {

// Polled by the loop; nothing here waits. The rules are the vendor's (sdk_surface.md, section 3):
//
//   - the request's identity is echoed, since clients match a reply by id;
//   - api 1 answers the service's version, an api the service does not have answers 3203;
//   - a request with noreply set is carried out and not answered;
//   - a reply waits until a response reader of the asking participant is matched, 300 ms at most:
//   response readers are
//     volatile, and ROS 2 clients make theirs with each call. The oldest waiting reply is given up
//     when 64 wait.
class ServiceHost {
 public:
  using WallTime = std::chrono::nanoseconds;

  // Throws BusError. `participant` must outlive the host.
  ServiceHost(const Participant& participant, std::vector<std::unique_ptr<Service>> services);

  // Takes requests, carries them out in order of arrival and sends the replies that can go. `now`
  // only has to grow.
  void Poll(RobotMode* mode, WallTime now);

  std::uint64_t requests() const { return requests_; }
  std::uint64_t lost_replies() const { return lost_replies_; }

 private:
  struct Pending {
    ParticipantKey client;
    unitree_api_msg_dds__ResponseHeader_ header;
    std::string data;
    WallTime give_up;
  };
  struct Channel {
    Channel(const Participant& participant, std::unique_ptr<Service> with);

    std::unique_ptr<Service> service;
    std::string request_topic, response_topic;
    Reader<unitree_api_msg_dds__Request_> requests;
    Writer<unitree_api_msg_dds__Response_> responses;
    std::deque<Pending> pending;
  };

  void Serve(Channel* channel, const unitree_api_msg_dds__Request_& request, WriterHandle writer,
             RobotMode* mode, WallTime now);
  void SendPending(Channel* channel, WallTime now);

  std::vector<std::unique_ptr<Channel>> channels_;
  std::uint64_t requests_ = 0;
  std::uint64_t lost_replies_ = 0;
};

// The reply to one request, without the network: api 1, the service's own apis, or 3203.
ServiceReply AnswerRequest(Service* service, std::int64_t api_id, std::string_view parameter,
                           RobotMode* mode);

}  // namespace understudy

#endif  // UNDERSTUDY_SERVICES_SERVICE_HOST_H_
