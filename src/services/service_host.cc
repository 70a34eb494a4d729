#include "services/service_host.h"

#include <algorithm>
#include <string>
#include <utility>

namespace understudy {
namespace {

constexpr std::int64_t kApiVersion = 1;
constexpr std::chrono::milliseconds kMatchPatience(300);  // assumed
constexpr std::size_t kMostPending = 64;                  // assumed

std::string Text(const char* text) { return text == nullptr ? std::string() : std::string(text); }

}  // namespace

ServiceReply AnswerRequest(Service* service, std::int64_t api_id, std::string_view parameter,
                           RobotMode* mode) {
  if (api_id == kApiVersion) return {.data = std::string(service->api_version())};
  if (auto reply = service->Handle(api_id, parameter, mode)) {
    // Clients get data with success only (unitree_sdk2_python rpc/server.py).
    if (reply->code != kRpcOk) reply->data.clear();
    return *reply;
  }
  return {.code = kRpcApiNotImplemented};
}

ServiceHost::Channel::Channel(const Participant& participant, std::unique_ptr<Service> with)
    : service(std::move(with)),
      request_topic("rt/api/" + std::string(service->name()) + "/request"),
      response_topic("rt/api/" + std::string(service->name()) + "/response"),
      requests(participant, {request_topic.c_str(), &unitree_api_msg_dds__Request__desc}),
      responses(participant, {response_topic.c_str(), &unitree_api_msg_dds__Response__desc}) {}

ServiceHost::ServiceHost(const Participant& participant,
                         std::vector<std::unique_ptr<Service>> services) {
  for (auto& service : services) {
    channels_.push_back(std::make_unique<Channel>(participant, std::move(service)));
  }
}

void ServiceHost::Poll(RobotMode* mode, WallTime now) {
  for (const auto& channel : channels_) {
    channel->requests.Take([&](const unitree_api_msg_dds__Request_& request, WriterHandle writer) {
      Serve(channel.get(), request, writer, mode, now);
    });
    if (!channel->pending.empty()) SendPending(channel.get(), now);
  }
}

void ServiceHost::Serve(Channel* channel, const unitree_api_msg_dds__Request_& request,
                        WriterHandle writer, RobotMode* mode, WallTime now) {
  ++requests_;
  const auto& identity = request.header.identity;
  ServiceReply reply =
      AnswerRequest(channel->service.get(), identity.api_id, Text(request.parameter), mode);
  if (request.header.policy.noreply) return;
  const auto client = channel->requests.ParticipantOf(writer);
  if (!client) return;  // it has gone
  if (channel->pending.size() >= kMostPending) {
    channel->pending.pop_front();
    ++lost_replies_;
  }
  unitree_api_msg_dds__ResponseHeader_ header{};
  header.identity.id = identity.id;
  header.identity.api_id = identity.api_id;
  header.status.code = reply.code;
  channel->pending.push_back({.client = *client,
                              .header = header,
                              .data = std::move(reply.data),
                              .give_up = now + kMatchPatience});
}

void ServiceHost::SendPending(Channel* channel, WallTime now) {
  const auto settled = [&](Pending& pending) {
    const bool reaches = channel->responses.ReachesParticipant(pending.client);
    if (!reaches && now < pending.give_up) return false;
    unitree_api_msg_dds__Response_ response{};
    response.header = pending.header;
    response.data = pending.data.data();
    // Past the wait it is sent all the same: a reader may be there that discovery has not told us
    // whose it is.
    if (!channel->responses.Write(response) || !reaches) ++lost_replies_;
    return true;
  };
  std::erase_if(channel->pending, settled);
}

}  // namespace understudy
