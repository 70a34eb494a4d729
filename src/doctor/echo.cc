#include "doctor/echo.h"

#include <algorithm>

#include <arpa/inet.h>
#include <netinet/in.h>

#include "bus/reader.h"
#include "bus/writer.h"
#include "doctor/echo_topics.h"

namespace understudy::doctor {
namespace {

constexpr std::string_view kEchoAnnounced = "understudy doctor echo ";
constexpr std::size_t kLongestName = 64;

// As the vendor's readers: best effort, so that what the network loses is lost. Deeper, so that
// nothing is lost here: 0.5 s of pings; *assumed*.
bus::ReaderOptions Deep(const Bell* bell) {
  return {.depth = 256, .reliable = false, .foreign_only = true, .bell = bell};
}

std::chrono::nanoseconds SystemTime() {
  return std::chrono::system_clock::now().time_since_epoch();
}

// Bounded, for what comes faster than it is taken.
template <class Reader, class Visit>
void TakeAll(Reader* reader, Visit&& visit) {
  constexpr int kMost = 64;
  for (int i = 0; i < kMost && reader->Take(visit) == bus::kMaxTake; ++i) {
  }
}

template <class Family>
class ClientOf final : public EchoClient {
 public:
  ClientOf(const bus::Participant& participant, const Bell* bell, std::uint32_t session)
      : session_(session),
        pongs_(participant, Family::kPong, Deep(bell)),
        pings_(participant, Family::kPing) {}

  void Try(std::uint32_t target) override { Write(target, 0); }

  void Send(std::uint32_t target, Time now) override {
    sent_at_.emplace_back(now);
    Write(target, static_cast<std::uint32_t>(sent_at_.size()));
  }

  void Receive(Time now) override {
    const auto visit = [&](const typename Family::Pong& pong, bus::WriterHandle) {
      const Mark mark = MarkOf(pong);
      if (mark.session == session_) {
        Note(mark.number, now, SystemTime(), std::chrono::nanoseconds(TimeOf(pong)));
      }
    };
    TakeAll(&pongs_, visit);
  }

 private:
  void Write(std::uint32_t target, std::uint32_t number) {
    Put({.session = session_, .target = target, .number = number}, &ping_);
    pings_.Write(ping_);
  }

  std::uint32_t session_;
  bus::Reader<typename Family::Pong> pongs_;
  bus::Writer<typename Family::Ping> pings_;
  typename Family::Ping ping_{};
};

}  // namespace

std::string AnnounceEcho(const std::string& name) { return std::string(kEchoAnnounced) + name; }

std::optional<std::string> EchoName(std::string_view announcement) {
  if (!announcement.starts_with(kEchoAnnounced)) return std::nullopt;
  announcement.remove_prefix(kEchoAnnounced.size());
  return std::string(announcement.substr(0, kLongestName));
}

std::vector<std::uint32_t> AnnouncedAddresses(const std::string& text) {
  std::vector<std::uint32_t> addresses;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    std::string one = text.substr(at, end - at);
    at = end + 1;
    if (const std::size_t slash = one.find('/'); slash != std::string::npos)
      one.erase(0, slash + 1);
    if (const std::size_t port = one.find(':'); port != std::string::npos) one.resize(port);
    in_addr address{};
    if (::inet_pton(AF_INET, one.c_str(), &address) != 1) continue;
    const std::uint32_t number = ntohl(address.s_addr);
    if (!IN_MULTICAST(number)) addresses.push_back(number);
  }
  return addresses;
}

template <class Family>
struct EchoServer::Half {
  Half(const bus::Participant& participant, const Bell* bell)
      : pings(participant, Family::kPing, Deep(bell)), pongs(participant, Family::kPong) {}

  // Returns how many it answered.
  std::uint64_t Answer(std::uint32_t tag) {
    std::uint64_t count = 0;
    const auto visit = [&](const typename Family::Ping& ping, bus::WriterHandle) {
      const Mark mark = MarkOf(ping);
      if (mark.target != tag) return;
      Put(mark, &pong);
      PutTime(SystemTime().count(), &pong);
      pongs.Write(pong);
      ++count;
    };
    TakeAll(&pings, visit);
    return count;
  }

  bus::Reader<typename Family::Ping> pings;
  bus::Writer<typename Family::Pong> pongs;
  typename Family::Pong pong{};
};

EchoServer::EchoServer(const bus::Participant& participant, const Bell* bell)
    : tag_(TagOf(participant.key())),
      go_(std::make_unique<Half<GoEcho>>(participant, bell)),
      hg_(std::make_unique<Half<HgEcho>>(participant, bell)) {}

EchoServer::~EchoServer() = default;

void EchoServer::Answer() { answered_ += go_->Answer(tag_) + hg_->Answer(tag_); }

void EchoClient::Note(std::uint32_t number, Time now, std::chrono::nanoseconds ours,
                      std::chrono::nanoseconds theirs) {
  answered_ = true;
  if (number == 0 || number > sent_at_.size()) return;
  std::optional<Time>& at = sent_at_[number - 1];
  if (!at) return;
  using Seconds = std::chrono::duration<double>;
  const double duration = Seconds(now - *at).count();
  durations_.push_back(duration);
  at.reset();
  // It was written at some moment of the way there and back, in the middle if both take as long.
  if (offset_ && duration / 2 >= offset_->error) return;
  // Unsigned, which a time that is nonsense cannot overflow.
  const std::uint64_t apart =
      static_cast<std::uint64_t>(theirs.count()) - static_cast<std::uint64_t>(ours.count());
  offset_ = ClockOffset{
      .ahead = static_cast<double>(static_cast<std::int64_t>(apart)) * 1e-9 + duration / 2,
      .error = duration / 2};
}

std::unique_ptr<EchoClient> MakeEchoClient(const bus::Participant& participant, const Bell* bell,
                                           bool hg, std::uint32_t session) {
  if (hg) return std::make_unique<ClientOf<HgEcho>>(participant, bell, session);
  return std::make_unique<ClientOf<GoEcho>>(participant, bell, session);
}

}  // namespace understudy::doctor
