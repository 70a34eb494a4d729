// The only file of the server that compiles Beast's WebSocket.
#include "server/web_sockets.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

#include "server/recordings.h"
#include "server/request_desk.h"

namespace understudy::server {
namespace {

using boost::system::error_code;
using nlohmann::json;
using nlohmann::ordered_json;

// Their common base. A pending operation owns the connection by a shared pointer.
class WebSocket : public Connection {
 public:
  WebSocket(Stream stream, Handshake handshake, Connections* connections, Shared* shared)
      : shared_(shared),
        connections_(connections),
        handshake_(std::move(handshake)),
        stream_(std::move(stream)),
        timer_(stream_.get_executor()) {}

  // Closes the connection of a client that neither reads nor answers pings.
  void Begin() override {
    stream_.set_option(
        boost::beast::websocket::stream_base::timeout{.handshake_timeout = shared_->limits.idle,
                                                      .idle_timeout = shared_->limits.silence,
                                                      .keep_alive_pings = true});
    stream_.read_message_max(shared_->limits.body_bytes);
    stream_.auto_fragment(false);
    stream_.text(true);
    stream_.async_accept(handshake_, [this, self = shared_from_this()](const error_code& error) {
      if (error) return Leave();
      Listen();
      OnOpen();
    });
  }
  void OnSnapshot(ShownSnapshot*) override {}

 protected:
  virtual void OnOpen() {}
  virtual void OnMessage(std::string_view) { Listen(); }
  virtual void OnSent() = 0;

  void Listen() {
    heard_.clear();
    stream_.async_read(
        heard_, [this, self = shared_from_this()](const error_code& error, std::size_t) {
          if (error) return Leave();
          OnMessage({static_cast<const char*>(heard_.cdata().data()), heard_.size()});
        });
  }

  // One at a time.
  void Send(std::shared_ptr<const std::string> text) {
    sending_ = std::move(text);
    stream_.async_write(boost::asio::buffer(*sending_),
                        [this, self = shared_from_this()](const error_code& error, std::size_t) {
                          sending_.reset();
                          if (error) return Leave();
                          OnSent();
                        });
  }
  void Send(const ordered_json& message) {
    Send(std::make_shared<const std::string>(JsonText(message)));
  }

  template <class Function>
  void At(std::chrono::steady_clock::time_point due, Function function) {
    timer_.expires_at(due);
    timer_.async_wait([self = shared_from_this(), function](const error_code& error) {
      if (!error) function();
    });
  }

  bool open() const { return stream_.is_open(); }

  Shared* const shared_;
  Connections* connections_;

 private:
  // Operations under way on the socket end with an error.
  void Leave() {
    timer_.cancel();
    error_code ignored;
    boost::beast::get_lowest_layer(stream_).socket().close(ignored);
    connections_->Remove(this);
  }

  Handshake handshake_;
  // Without compression, which is not needed and compiles slowly.
  boost::beast::websocket::stream<Stream, false> stream_;
  boost::asio::steady_timer timer_;
  boost::beast::flat_buffer heard_;
  std::shared_ptr<const std::string> sending_;
};

class SnapshotWatch final : public WebSocket {
 public:
  SnapshotWatch(Stream stream, Handshake handshake, const WatchSnapshots& wanted,
                Connections* connections, Shared* shared)
      : WebSocket(std::move(stream), std::move(handshake), connections, shared),
        parts_(wanted.parts),
        period_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1 / wanted.hz))) {}

  void OnSnapshot(ShownSnapshot* shown) override {
    if (open()) Send(shown->Json(parts_));
  }

 private:
  using Clock = std::chrono::steady_clock;

  void OnOpen() override {
    due_ = Clock::now();
    OnSent();
  }
  void OnSent() override {
    At(due_, [this] {
      // One that has fallen behind goes on from now.
      due_ = std::max(due_ + period_, Clock::now());
      shared_->pump->Ask(parts_, shared_from_this());
    });
  }

  emulator::SnapshotParts parts_;
  Clock::duration period_;
  Clock::time_point due_;
};

class EventWatch final : public WebSocket {
 public:
  using WebSocket::WebSocket;

 private:
  void OnOpen() override { OnSent(); }
  // A client too slow for the history continues with the oldest kept event.
  void OnSent() override {
    const auto& newest = shared_->plane.events.newest();
    const auto event = std::ranges::find_if(
        newest, [this](const KnownEvent& known) { return known.number >= next_; });
    if (event == newest.end()) {
      return At(std::chrono::steady_clock::now() + kEventsEvery, [this] { OnSent(); });
    }
    next_ = event->number + 1;
    Send(EventJson(*event));
  }

  std::uint64_t next_ = 0;  // number of the next event to be sent
};

// Reads the request of a message, to `robot` unless it names one, and the id of its answer. Never
// recurses, since a client chooses how deep a message is.
Result<emulator::Request> ReadMessage(std::string_view message, std::size_t robot,
                                      ordered_json* id) {
  const json said = json::parse(message, nullptr, false);
  const Error form{R"(expected {"NAME": {...}, "id": text or number})"};
  if (!said.is_object() || said.empty() || said.size() > 2) return form;
  const json* values = nullptr;
  std::string name;
  for (const auto& item : said.items()) {
    if (item.key() == "id") {
      if (item.value().is_structured()) return form;
      *id = item.value();
    } else if (values == nullptr) {
      name = item.key();
      values = &item.value();
    } else {
      return form;
    }
  }
  if (values == nullptr) return form;
  auto request = emulator::ReadRequest(name, *values);
  if (request && !values->contains(emulator::kRobotField.key)) request->robot = robot;
  return request;
}

class RequestLine final : public WebSocket {
 public:
  using WebSocket::WebSocket;

 private:
  void OnMessage(std::string_view message) override {
    listening_ = false;
    try {
      ordered_json id;
      const auto request = ReadMessage(message, shared_->plane.robot, &id);
      if (!request) return Answer(id, ErrorReply(400, request.why()));
      if (const std::string why = RefusedOverTcp(*request);
          connections_->access() != nullptr && !why.empty()) {
        return Answer(id, ErrorReply(403, why));
      }
      const bool in_turn = !request->waits();
      in_turn_ = in_turn;
      shared_->desk->Ask(*request,
                         [this, self = shared_from_this(), id, in_turn](const HttpReply& reply) {
                           if (in_turn) in_turn_ = false;
                           Answer(id, reply);
                         });
      GoOn();
    } catch (const std::exception& failure) {  // no memory for it
      in_turn_ = false;
      Answer(nullptr, ErrorReply(500, failure.what()));
    }
  }
  void OnSent() override {
    answers_.pop_front();
    if (!answers_.empty()) return Send(answers_.front());
    GoOn();
  }

  void Answer(const ordered_json& id, const HttpReply& reply) {
    ordered_json answer{{"id", id}, {"status", reply.status}};
    answer.update(ordered_json::parse(reply.content()));
    answers_.push_back(std::move(answer));
    if (answers_.size() == 1) Send(answers_.front());
  }

  // Stops reading from a client that does not read its answers.
  void GoOn() {
    if (listening_ || in_turn_ || !answers_.empty()) return;
    listening_ = true;
    Listen();
  }

  std::deque<ordered_json> answers_;  // the first is being sent
  bool listening_ = true;
  bool in_turn_ = false;  // a request that others have to wait for is asked
};

}  // namespace

std::shared_ptr<Connection> MakeWebSocket(Stream stream, Handshake handshake, const Routed& routed,
                                          Connections* connections, Shared* shared) {
  if (const auto* watch = std::get_if<WatchSnapshots>(&routed)) {
    return std::make_shared<SnapshotWatch>(std::move(stream), std::move(handshake), *watch,
                                           connections, shared);
  }
  if (std::holds_alternative<WatchEvents>(routed)) {
    return std::make_shared<EventWatch>(std::move(stream), std::move(handshake), connections,
                                        shared);
  }
  return std::make_shared<RequestLine>(std::move(stream), std::move(handshake), connections,
                                       shared);
}

}  // namespace understudy::server
