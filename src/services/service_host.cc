#include "services/service_host.h"

#include <algorithm>
#include <exception>
#include <string_view>

#include <nlohmann/json.hpp>

#include "services/parameter.h"
#include "wire/robot_topics.h"

namespace understudy::services {
namespace {

constexpr std::chrono::seconds kNoticePeriod(1);
constexpr std::chrono::seconds kPicturePatience(10);  // assumed
constexpr std::size_t kMostPending = 64;              // assumed
constexpr std::size_t kMostWaiting = 10;              // the server of the vendor's Python SDK
constexpr int kMostServed = 8;                        // assumed
constexpr int kPollsPerCount = 10;                    // assumed
// Assumed: a thousand calls a second, with the process stalled for a quarter of a second.
constexpr int kReaderDepth = 256;
// The longest request that is kept: one of the longest parameter and the longest binary part, and
// as much again, so that those a little too long are answered.
constexpr std::size_t kMostRequestBytes = 2 * (kMostParameterBytes + kMostBinaryBytes);

// In nanoseconds, as measured (docs/dev/performance.md): with one call more than kMostWork, the
// longest, a poll takes 0.2 ms, a fifth of a tick.
constexpr std::int64_t kMostWork = 60'000;     // in a poll
constexpr std::int64_t kWorkOfCall = 10'000;   // without its parameter
constexpr std::int64_t kWorkOfByte = 8;        // of a parameter
constexpr std::int64_t kWorkOfReply = 10'000;  // also of one that cannot be sent yet
constexpr std::int64_t kWorkOfReader = 1'000;  // of each that is asked whether it is the client's

}  // namespace

ServiceHost::Channel::Channel(const bus::Participant& participant, const std::string& channel_name,
                              Service* of, bool leases, std::atomic<bool>* mail, Responses* outlet)
    : name(channel_name),
      service(of),
      is_lease(leases),
      reader(participant, {wire::RequestTopic(name).c_str(), &unitree_api_msg_dds__Request__desc},
             {.depth = kReaderDepth, .most_bytes = kMostRequestBytes, .mail = mail}),
      responses(outlet) {}

ServiceHost::ServiceHost(const bus::Participant& participant, wire::Outlets* outlets,
                         std::vector<ServiceTable> tables, Log log,
                         const std::vector<std::string>& status_texts)
    : log_(std::move(log)) {
  for (ServiceTable& table : tables) {
    services_.push_back(std::make_unique<Service>(std::move(table)));
  }
  const std::vector<wire::RobotTopic> topics = wire::ServiceTopics(names(), status_texts);
  for (const wire::RobotTopic& topic : topics) topics_.push_back(topic.name);
  std::span<const wire::RobotTopic> left = topics;
  const auto next = [&left] {
    const wire::RobotTopic& first = left.front();
    left = left.subspan(1);
    return first;
  };
  for (const auto& service : services_) {
    const std::string name(service->table().name);
    for (const bool leases : {false, true}) {
      channels_.push_back(std::make_unique<Channel>(
          participant, leases ? wire::LeaseOf(name) : name, service.get(), leases, &mail_,
          outlets->Open<unitree_api_msg_dds__Response_>(next())));
    }
    if (service->table().has_switch_topics) switches_.emplace(participant, service.get(), &mail_);
  }
  if (left.front().name == wire::topic::kConfigChangeStatus.name) {
    config_changes_ = outlets->Open<unitree_go_msg_dds__ConfigChangeStatus_>(next());
  }
  texts_.emplace(outlets, left, services_);
  faults_.resize(services_.size());
}

std::vector<std::string> ServiceHost::names() const {
  std::vector<std::string> names;
  for (const auto& service : services_) names.emplace_back(service->table().name);
  return names;
}

void ServiceHost::ApplyFaults(std::span<const robot::ServiceEffects> faults) noexcept {
  std::ranges::copy(faults, faults_.begin());
}

const robot::ServiceEffects& ServiceHost::FaultOf(const Service& service) const {
  const auto found = std::ranges::find(services_, &service, &std::unique_ptr<Service>::get);
  return faults_[static_cast<std::size_t>(found - services_.begin())];
}

void ServiceHost::Tell(const authority::MotorOwner& owner, double t) noexcept {
  try {
    texts_->Tell(owner, t);
  } catch (const std::exception&) {
    // Out of memory: the text is left out.
  }
}

std::vector<const bus::ReaderCore*> ServiceHost::readers() const {
  std::vector<const bus::ReaderCore*> readers;
  for (const auto& channel : channels_) readers.push_back(&channel->reader);
  return readers;
}

std::span<const Call> ServiceHost::Poll(authority::MotorOwner* owner, WallTime now) noexcept {
  calls_.clear();
  if (Idle()) return calls_;
  try {
    if (switches_) switches_->Poll(owner, &calls_);
    for (const Call& call : calls_) Refused(call.refusal) += call.times;
  } catch (const std::exception&) {
    // Out of memory: the switch stays as it was.
  }
  if (pictures_ != nullptr) TakePictures(now);
  // Where the work ends, the next poll goes on with the channel after: a flood of requests to one
  // does not keep the others waiting.
  Work work = kMostWork;
  std::size_t next = 0;
  waits_ = false;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const std::size_t at = (first_ + i) % channels_.size();
    const bool could = work > 0;
    try {
      PollChannel(channels_[at].get(), owner, now, &work);
    } catch (const std::exception&) {
      ++counts_.lost_replies;  // out of memory: the request gets no reply
    }
    waits_ |= !channels_[at]->waiting.empty() || !channels_[at]->pending.empty();
    if (could && work <= 0) next = (at + 1) % channels_.size();
  }
  first_ = next;
  FollowPrograms(*owner);
  return calls_;
}

void ServiceHost::FollowPrograms(const authority::MotorOwner& owner) {
  const auto changed = std::ranges::find_if(channels_, [&](const auto& channel) {
    return channel->reader.is_open() != IsServed(*channel->service, owner);
  });
  if (changed == channels_.end() || !(*changed)->waiting.empty()) return;
  bus::RawReader<unitree_api_msg_dds__Request_>& reader = (*changed)->reader;
  try {
    reader.Open(!reader.is_open());
  } catch (const std::exception&) {
    // Out of memory: it is tried again.
  }
}

// There are some forty readers, and most ticks bring nothing. The flag is lowered before the
// readers are asked: what arrives meanwhile raises it again.
bool ServiceHost::Idle() {
  const bool mail =
      mail_.load(std::memory_order_relaxed) && mail_.exchange(false, std::memory_order_acquire);
  if (!mail && !waits_ && ++idle_polls_ < kPollsPerCount) return true;
  idle_polls_ = 0;
  return false;
}

void ServiceHost::PollChannel(Channel* channel, authority::MotorOwner* owner, WallTime now,
                              Work* work) {
  Receive(channel);
  if (!channel->pending.empty()) SendPending(channel, *owner, now, work);
  auto& waiting = channel->waiting;
  for (int served = 0; served < kMostServed && !waiting.empty() && *work > 0; ++served) {
    auto chosen =
        std::ranges::find_if(waiting, [](const Request& one) { return one.view.priority > 0; });
    if (chosen == waiting.end()) chosen = waiting.begin();
    const Request request = std::move(*chosen);
    waiting.erase(chosen);
    *work -= WorkOf(request);
    Serve(channel, request, owner, now, work);
  }
}

ServiceHost::Work ServiceHost::WorkOfReply(const Channel& channel) {
  return kWorkOfReply + kWorkOfReader * channel.responses->readers();
}

ServiceHost::Work ServiceHost::WorkOf(const Request& request) {
  const std::size_t parsed = std::min(request.view.parameter.size(), kMostParameterBytes);
  return kWorkOfCall + kWorkOfByte * static_cast<Work>(parsed);
}

std::optional<Call> ServiceHost::Answer(std::string_view service, std::int64_t api_id,
                                        std::string_view parameter, authority::MotorOwner* owner,
                                        WallTime now) noexcept {
  const auto found = std::ranges::find_if(
      services_, [&](const std::unique_ptr<Service>& one) { return one->table().name == service; });
  if (found == services_.end() || !IsServed(**found, *owner) || FaultOf(**found).off) {
    return std::nullopt;
  }
  try {
    const ServiceRequest request{
        .api_id = api_id, .parameter = parameter, .parameter_bytes = parameter.size()};
    const ServiceReply reply = CarryOut(found->get(), request, owner, now);
    if (reply.refusal != CallRefusal::kNone) ++Refused(reply.refusal);
    return Call{.service = (*found)->table().name,
                .api_id = api_id,
                .code = reply.code,
                .refusal = reply.refusal,
                .name = (*found)->NameOf(api_id)};
  } catch (const std::exception&) {
    return std::nullopt;  // out of memory
  }
}

void ServiceHost::Tell(const Call& call) {
  if (call.refusal != CallRefusal::kNone) Refused(call.refusal) += call.times;
  calls_.push_back(call);
}

void ServiceHost::Receive(Channel* channel) {
  bus::CdrSample sample;
  while (channel->waiting.size() < kMostWaiting && channel->reader.Next(&sample)) {
    ++counts_.requests;
    const std::optional<RequestView> view = ReadRequest(sample.bytes());
    if (!view) {
      Tell({.service = channel->name, .code = Call::kNoCode, .refusal = CallRefusal::kUndecoded});
      continue;
    }
    Request request{.sample = {}, .view = *view, .client = std::nullopt};
    if (!view->noreply) request.client = channel->reader.ParticipantOf(sample.writer());
    request.sample = std::move(sample);
    channel->waiting.push_back(std::move(request));
  }
  const auto tell_more = [&](std::uint64_t* told, std::uint64_t now, CallRefusal refusal) {
    const std::uint64_t more = now - std::exchange(*told, now);
    if (more == 0) return;
    counts_.requests += more;
    Tell({.service = channel->name, .code = Call::kNoCode, .refusal = refusal, .times = more});
  };
  tell_more(&channel->lost, channel->reader.lost(), CallRefusal::kTooMany);
  tell_more(&channel->undecoded, channel->reader.undecoded(), CallRefusal::kUndecoded);
}

void ServiceHost::Serve(Channel* channel, const Request& request, authority::MotorOwner* owner,
                        WallTime now, Work* work) {
  Service& service = *channel->service;
  const RequestView& view = request.view;
  Call call{.service = channel->name,
            .api_id = view.api_id,
            .name = channel->is_lease ? std::string_view() : service.NameOf(view.api_id)};
  const robot::ServiceEffects& fault = FaultOf(service);
  if (!IsServed(service, *owner) || fault.off) {
    call.code = Call::kNoCode;
    call.refusal = CallRefusal::kNotServed;
    return Tell(call);
  }
  ServiceReply reply = channel->is_lease
                           ? service.lease().Answer(view.api_id, view.parameter, view.lease_id, now)
                           : CarryOut(&service,
                                      {.api_id = view.api_id,
                                       .lease_id = view.lease_id,
                                       .parameter = view.parameter,
                                       .parameter_bytes = view.parameter.size(),
                                       .binary_bytes = view.binary_bytes},
                                      owner, now);
  call.code = reply.code;
  call.refusal = reply.refusal;
  const bool answers = !view.noreply && request.client;
  const PictureSource::Order order =
      reply.picture && answers && pictures_ != nullptr ? pictures_->Begin(service.table().name) : 0;
  if (order == 0 && (!channel->is_lease || reply.refusal != CallRefusal::kNone)) Tell(call);
  if (!answers) return;
  unitree_api_msg_dds__ResponseHeader_ header{};
  header.identity.id = view.id;
  header.identity.api_id = view.api_id;
  header.status.code = reply.code;
  const WallTime not_before =
      now + std::chrono::duration_cast<WallTime>(std::chrono::duration<double>(fault.delay));
  Pending pending{.client = *request.client,
                  .header = header,
                  .data = std::move(reply.data),
                  .order = order,
                  .call = call,
                  .picture = nullptr,
                  .once = reply.once,
                  .not_before = not_before,
                  .give_up = not_before + (order == 0 ? reply.patience : kPicturePatience)};
  *work -= WorkOfReply(*channel);
  if (Settle(channel, &pending, owner->state(), now)) return;
  if (channel->pending.size() >= kMostPending) {
    channel->pending.pop_front();
    ++counts_.lost_replies;
  }
  channel->pending.push_back(std::move(pending));
}

ServiceReply ServiceHost::CarryOut(Service* service, const ServiceRequest& request,
                                   authority::MotorOwner* owner, WallTime now) {
  std::string notice;
  ServiceReply reply = service->Answer(request, owner, now, &notice);
  if (!notice.empty()) Say(*service, request.api_id, notice, now);
  if (reply.change) Announce(*reply.change);
  return reply;
}

void ServiceHost::Announce(ConfigChange change) {
  if (config_changes_ == nullptr) return;
  unitree_go_msg_dds__ConfigChangeStatus_ message{.name = change.name.data(),
                                                  .content = change.content.data()};
  config_changes_->Send(&message);
}

// With half of the work at most, so that replies to clients who have no reader yet do not keep
// calls waiting. Those that cannot be sent yet go to the end, so that they come back in their
// order.
void ServiceHost::SendPending(Channel* channel, const authority::MotorOwner& owner, WallTime now,
                              Work* work) {
  const robot::MotionState& state = owner.state();
  const Work enough = *work / 2;
  for (std::size_t left = channel->pending.size(); left > 0 && *work > enough; --left) {
    Pending pending = std::move(channel->pending.front());
    channel->pending.pop_front();
    *work -= WorkOfReply(*channel);
    if (!Settle(channel, &pending, state, now)) channel->pending.push_back(std::move(pending));
  }
}

void ServiceHost::TakePictures(WallTime now) {
  for (; const Picture* const picture = pictures_->Front(); pictures_->Pop()) {
    const bool lost = picture->outcome == Picture::Outcome::kLost;
    for (const auto& channel : channels_) {
      for (Pending& pending : channel->pending) {
        if (pending.order != picture->order) continue;
        const bool drawn = picture->outcome == Picture::Outcome::kDrawn;
        pending.order = 0;
        pending.call.code = lost ? Call::kNoCode : drawn ? kRpcOk : pending.call.code;
        pending.call.refusal = drawn ? CallRefusal::kNone : CallRefusal::kFailed;
        Tell(pending.call);
        pending.header.status.code = pending.call.code;
        pending.picture = picture->jpeg;
        pending.give_up = std::max(now, pending.not_before) + ServiceReply{}.patience;
      }
      if (!lost) continue;
      std::erase_if(channel->pending, [](const Pending& pending) {
        return pending.header.status.code == Call::kNoCode;
      });
    }
  }
}

// Sends the reply, or gives it up; false if it has to wait.
bool ServiceHost::Settle(Channel* channel, Pending* pending, const robot::MotionState& state,
                         WallTime now) {
  if (now < pending->not_before) return false;
  const bool over = now >= pending->give_up;
  if (pending->order != 0) {
    if (!over) return false;
    pending->call.refusal = CallRefusal::kFailed;
    Tell(pending->call);
  }
  if (pending->once != nullptr && !pending->once(state) && !over) return false;
  const bool reaches = channel->responses->writer().ReachesParticipant(pending->client);
  if (!reaches && !over) return false;
  unitree_api_msg_dds__Response_ response{};
  response.header = pending->header;
  response.data = pending->data.data();
  if (pending->picture != nullptr) {
    const auto bytes = static_cast<std::uint32_t>(pending->picture->size());
    // Cyclone does not write to what it sends.
    response.binary = {._maximum = bytes,
                       ._length = bytes,
                       ._buffer = const_cast<std::uint8_t*>(pending->picture->data()),
                       ._release = false};
  }
  // After the wait the reply is sent anyway: there may be a reader whose participant discovery
  // has not reported yet.
  if (!channel->responses->Send(&response) || !reaches) ++counts_.lost_replies;
  return true;
}

void ServiceHost::Say(const Service& service, std::int64_t api_id, const std::string& notice,
                      WallTime now) {
  const auto [last, first] = said_.try_emplace({&service, api_id}, now);
  if (!first && now < last->second + kNoticePeriod) return;
  last->second = now;
  log_(notice);
}

}  // namespace understudy::services
