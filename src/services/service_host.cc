#include "services/service_host.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <string_view>

#include <nlohmann/json.hpp>

#include "services/parameter.h"

namespace understudy::services {
namespace {

constexpr std::chrono::seconds kNoticePeriod(1);
constexpr std::size_t kMostPending = 64;  // assumed
constexpr std::size_t kMostNormal = 10;   // the server of the vendor's Python SDK
constexpr std::size_t kMostUrgent = 5;
constexpr int kMostServed = 8;  // assumed: bounds the time of a poll
// Assumed: a thousand calls a second, with the process stalled for a quarter of a second.
constexpr int kReaderDepth = 256;

}  // namespace

ServiceHost::Channel::Channel(const bus::Participant& participant, const std::string& name,
                              Service* of, bool leases)
    : service(of),
      is_lease(leases),
      request_topic("rt/api/" + name + "/request"),
      response_topic("rt/api/" + name + "/response"),
      reader(participant, {request_topic.c_str(), &unitree_api_msg_dds__Request__desc},
             {.depth = kReaderDepth}),
      writer(participant, {response_topic.c_str(), &unitree_api_msg_dds__Response__desc}) {}

ServiceHost::ServiceHost(const bus::Participant& participant, std::vector<ServiceTable> tables,
                         Say say, const std::vector<std::string>& status_texts)
    : say_(std::move(say)) {
  for (ServiceTable& table : tables) {
    const std::string name(table.name);
    const bool tells_changes = table.tells_changes, has_switch_topics = table.has_switch_topics;
    Service* service = services_.emplace_back(std::make_unique<Service>(std::move(table))).get();
    channels_.push_back(std::make_unique<Channel>(participant, name, service, false));
    channels_.push_back(std::make_unique<Channel>(participant, name + "_lease", service, true));
    if (has_switch_topics) switches_.emplace(participant, service);
    if (tells_changes) {
      config_changes_.emplace(participant, bus::Topic<unitree_go_msg_dds__ConfigChangeStatus_>{
                                               "rt/config_change_status",
                                               &unitree_go_msg_dds__ConfigChangeStatus__desc});
    }
  }
  texts_.emplace(participant, status_texts, services_);
}

void ServiceHost::Tell(const authority::MotorOwner& owner, double t) noexcept {
  try {
    texts_->Tell(owner, t);
  } catch (const std::exception&) {
    // Out of memory: the text is left out.
  }
}

std::span<const Call> ServiceHost::Poll(authority::MotorOwner* owner, WallTime now) noexcept {
  calls_.clear();
  try {
    if (switches_) switches_->Poll(owner);
  } catch (const std::exception&) {
    // Out of memory: the switch stays as it was.
  }
  for (const auto& channel : channels_) {
    try {
      Receive(channel.get());
      for (int served = 0; served < kMostServed; ++served) {
        auto& queue = channel->urgent.empty() ? channel->normal : channel->urgent;
        if (queue.empty()) break;
        const Request request = std::move(queue.front());
        queue.pop_front();
        Serve(channel.get(), request, owner, now);
      }
      if (!channel->pending.empty()) SendPending(channel.get(), *owner, now);
    } catch (const std::exception&) {
      ++counts_.lost_replies;  // out of memory: the request gets no reply
    }
  }
  return calls_;
}

std::optional<std::int32_t> ServiceHost::Answer(std::string_view service, std::int64_t api_id,
                                                std::string_view parameter,
                                                authority::MotorOwner* owner,
                                                WallTime now) noexcept {
  const auto found = std::ranges::find_if(
      services_, [&](const std::unique_ptr<Service>& one) { return one->table().name == service; });
  if (found == services_.end() || !(*found)->IsServed(*owner)) return std::nullopt;
  try {
    const ServiceRequest request{
        .api_id = api_id, .parameter = parameter, .parameter_bytes = parameter.size()};
    return CarryOut(found->get(), request, owner, now).code;
  } catch (const std::exception&) {
    return std::nullopt;  // out of memory
  }
}

void ServiceHost::Receive(Channel* channel) {
  // Requests that do not fit stay in the reader.
  const std::size_t room = kMostNormal - channel->normal.size();
  if (room == 0) return;
  channel->reader.Take(
      [&](const unitree_api_msg_dds__Request_& message, bus::WriterHandle writer) {
        ++counts_.requests;
        const char* text = message.parameter == nullptr ? "" : message.parameter;
        const std::size_t bytes = std::strlen(text);
        Request request{.id = message.header.identity.id,
                        .api_id = message.header.identity.api_id,
                        .lease_id = message.header.lease.id,
                        .noreply = message.header.policy.noreply,
                        .parameter = bytes > kMostParameterBytes ? "" : text,
                        .parameter_bytes = bytes,
                        .binary_bytes = message.binary._length,
                        .client = std::nullopt};
        if (!request.noreply) request.client = channel->reader.ParticipantOf(writer);
        auto& queue = message.header.policy.priority > 0 ? channel->urgent : channel->normal;
        queue.push_back(std::move(request));
        if (channel->urgent.size() > kMostUrgent) {
          channel->urgent.pop_front();
          ++counts_.lost_replies;
        }
      },
      static_cast<int>(room));
}

void ServiceHost::Serve(Channel* channel, const Request& request, authority::MotorOwner* owner,
                        WallTime now) {
  Service& service = *channel->service;
  if (!service.IsServed(*owner)) return;
  ServiceReply reply = channel->is_lease ? service.lease().Answer(request.api_id, request.parameter,
                                                                  request.lease_id, now)
                                         : CarryOut(&service,
                                                    {.api_id = request.api_id,
                                                     .lease_id = request.lease_id,
                                                     .parameter = request.parameter,
                                                     .parameter_bytes = request.parameter_bytes,
                                                     .binary_bytes = request.binary_bytes},
                                                    owner, now);
  if (reply.code != 0) ++counts_.refused;
  if (!channel->is_lease) {
    calls_.push_back(
        {.service = service.table().name, .api_id = request.api_id, .code = reply.code});
  }
  if (request.noreply || !request.client) return;
  if (channel->pending.size() >= kMostPending) {
    channel->pending.pop_front();
    ++counts_.lost_replies;
  }
  unitree_api_msg_dds__ResponseHeader_ header{};
  header.identity.id = request.id;
  header.identity.api_id = request.api_id;
  header.status.code = reply.code;
  channel->pending.push_back({.client = *request.client,
                              .header = header,
                              .data = std::move(reply.data),
                              .once = reply.once,
                              .give_up = now + reply.patience});
}

ServiceReply ServiceHost::CarryOut(Service* service, const ServiceRequest& request,
                                   authority::MotorOwner* owner, WallTime now) {
  std::string notice;
  ServiceReply reply = service->Answer(request, owner, now, &notice);
  if (!notice.empty()) Tell(*service, request.api_id, notice, now);
  if (reply.change) Announce(*reply.change);
  return reply;
}

void ServiceHost::Announce(ConfigChange change) {
  if (!config_changes_) return;
  config_changes_->Write({.name = change.name.data(), .content = change.content.data()});
}

void ServiceHost::SendPending(Channel* channel, const authority::MotorOwner& owner, WallTime now) {
  const robot::MotionState state = owner.state();
  const auto settled = [&](Pending& pending) {
    const bool over = now >= pending.give_up;
    if (pending.once != nullptr && !pending.once(state) && !over) return false;
    const bool reaches = channel->writer.ReachesParticipant(pending.client);
    if (!reaches && !over) return false;
    unitree_api_msg_dds__Response_ response{};
    response.header = pending.header;
    response.data = pending.data.data();
    // After the wait the reply is sent anyway: there may be a reader whose participant discovery
    // has not reported yet.
    if (!channel->writer.Write(response) || !reaches) ++counts_.lost_replies;
    return true;
  };
  std::erase_if(channel->pending, settled);
}

void ServiceHost::Tell(const Service& service, std::int64_t api_id, const std::string& notice,
                       WallTime now) {
  const auto [last, first] = told_.try_emplace({&service, api_id}, now);
  if (!first && now < last->second + kNoticePeriod) return;
  last->second = now;
  say_(notice);
}

SwitchTopics::SwitchTopics(const bus::Participant& participant, Service* uwb_switch)
    : uwb_switch_(uwb_switch),
      lidar_(participant, {"rt/utlidar/switch", &std_msgs_msg_dds__String__desc}),
      uwb_(participant, {"rt/uwbswitch", &unitree_go_msg_dds__UwbSwitch__desc}) {}

void SwitchTopics::Poll(authority::MotorOwner* owner) {
  lidar_.Take([&](const std_msgs_msg_dds__String_& message, bus::WriterHandle) {
    const std::string_view word = message.data == nullptr ? "" : message.data;
    if (word == "ON" || word == "OFF") owner->Switch("unitree_lidar", word == "ON");
  });
  uwb_.Take([&](const unitree_go_msg_dds__UwbSwitch_& message, bus::WriterHandle) {
    uwb_switch_->Set("enable", message.enabled == 0 ? 0 : 1);
  });
}

}  // namespace understudy::services
