#include "server/routes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "base/nearest_word.h"
#include "server/frame_json.h"
#include "server/metrics.h"
#include "server/order_json.h"
#include "server/report_json.h"

namespace understudy::server {
namespace {

using nlohmann::ordered_json;

constexpr double kLeastHz = 1, kMostHz = 240;  // of frames; *assumed*, more than screens show

std::string Text(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Routed FromReading(const OrderReading& reading) {
  if (const auto* why = std::get_if<std::string>(&reading)) return ErrorReply(400, *why);
  return std::get<emulator::Order>(reading);
}

Routed GetStatus(const HttpRequest&, std::string_view, Plane& plane) {
  return HttpReply{.body = Text(StatusJson(plane.identity, plane.board->Read()))};
}

// The parts that a request names, or all; else why it cannot be read.
std::variant<emulator::FrameParts, std::string> PartsOf(const HttpRequest& request) {
  const auto list = QueryValue(request, "parts");
  if (!list) return emulator::kAllFrameParts;
  std::string unknown;
  if (const auto parts = ReadFrameParts(*list, &unknown)) return *parts;
  std::vector<std::string> names;
  for (const emulator::FramePartName& part : emulator::kFrameParts) names.emplace_back(part.name);
  return "parts: a frame has no " + unknown.substr(0, 32) +
         DidYouMean(unknown.substr(0, 32), names);
}

// Frames a second that a request asks for; NaN for what is none.
double HzOf(const HttpRequest& request) {
  const auto text = QueryValue(request, "hz");
  if (!text) return 60;
  double hz = 0;
  const char* const end = text->data() + text->size();
  const bool read = std::from_chars(text->data(), end, hz).ptr == end && !text->empty();
  return read && hz >= kLeastHz && hz <= kMostHz ? hz : std::nan("");
}

Routed GetFrame(const HttpRequest& request, std::string_view, Plane&) {
  const auto parts = PartsOf(request);
  if (const auto* why = std::get_if<std::string>(&parts)) return ErrorReply(400, *why);
  return FromFrame{.parts = std::get<emulator::FrameParts>(parts),
                   .reply = [](const emulator::Frame& frame, emulator::FrameParts asked, Plane&) {
                     return HttpReply{.body = FrameJson(frame, asked) + "\n"};
                   }};
}

Routed GetRefusals(const HttpRequest&, std::string_view, Plane&) {
  return FromFrame{.parts = emulator::kPartRefusals,
                   .reply = [](const emulator::Frame& frame, emulator::FrameParts, Plane&) {
                     return HttpReply{.body = Text(RefusalsJson(frame))};
                   }};
}

Routed GetMetrics(const HttpRequest&, std::string_view, Plane&) {
  return FromFrame{.parts = kMetricsParts,
                   .reply = [](const emulator::Frame& frame, emulator::FrameParts, Plane& plane) {
                     return HttpReply{
                         .body = MetricsText(plane.identity, plane.board->Read(), frame),
                         .type = kMetricsType};
                   }};
}

Routed GetTimings(const HttpRequest&, std::string_view, Plane& plane) {
  return HttpReply{.body = Text(TimingsJson(plane.board->Read()))};
}

// The document is small and rarely asked for.
Routed GetOpenApi(const HttpRequest&, std::string_view, Plane& plane) {
  std::ifstream file(plane.openapi);
  if (!file) return ErrorReply(404, "this installation has no openapi.yaml");
  return HttpReply{.body = std::string(std::istreambuf_iterator<char>(file), {}),
                   .type = "application/yaml"};
}

HttpReply UpgradeRequired(std::string_view path) {
  HttpReply reply = ErrorReply(426, std::string{path} + " is a WebSocket");
  reply.fields = {{"Upgrade", "websocket"}, {"Connection", "Upgrade"}};
  return reply;
}

Routed GetFrames(const HttpRequest& request, std::string_view, Plane&) {
  const auto parts = PartsOf(request);
  if (const auto* why = std::get_if<std::string>(&parts)) return ErrorReply(400, *why);
  const double hz = HzOf(request);
  if (!(hz > 0)) return ErrorReply(400, "hz: expected a number from 1 to 240");
  if (!request.upgrade) return UpgradeRequired("/frames");
  return WatchFrames{.parts = std::get<emulator::FrameParts>(parts), .hz = hz};
}

Routed GetOrders(const HttpRequest& request, std::string_view, Plane&) {
  if (!request.upgrade) return UpgradeRequired("/orders");
  return TakeOrders{};
}

Routed GetScene(const HttpRequest&, std::string_view, Plane& plane) {
  return plane.scene ? plane.scene->Scene() : ErrorReply(404, "there is no scene");
}

Routed GetMesh(const HttpRequest&, std::string_view index, Plane& plane) {
  return plane.scene ? plane.scene->Mesh(index) : ErrorReply(404, "there is no scene");
}

Routed GetHeightField(const HttpRequest&, std::string_view index, Plane& plane) {
  return plane.scene ? plane.scene->HeightField(index) : ErrorReply(404, "there is no scene");
}

Routed GetModel(const HttpRequest&, std::string_view, Plane& plane) {
  return plane.scene ? plane.scene->Model() : ErrorReply(404, "there is no scene");
}

Routed GetIndex(const HttpRequest& request, std::string_view, Plane& plane) {
  return plane.files.Get("index.html", request.if_none_match);
}

Routed GetFile(const HttpRequest& request, std::string_view path, Plane& plane) {
  return plane.files.Get(path, request.if_none_match);
}

Routed GetPanel(const HttpRequest&, std::string_view, Plane& plane) {
  if (plane.url.empty())
    return ErrorReply(404, "this robot has no panel, for it serves nothing on TCP");
  return HttpReply{.body = Text({{"url", plane.url}})};
}

Routed PostCrane(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadCraneOrder(request.body));
}

Routed PostClamp(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadClampOrder(request.body));
}

Routed PostReset(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadResetOrder(request.body));
}

Routed PostPause(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadPauseOrder(request.body));
}

Routed PostStep(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadStepOrder(request.body));
}

Routed PostSpeed(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadSpeedOrder(request.body));
}

Routed PostDrag(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadDragOrder(request.body));
}

Routed PostPush(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadPushOrder(request.body));
}

Routed PostRemote(const HttpRequest& request, std::string_view, Plane&) {
  return FromReading(ReadRemoteOrder(request.body));
}

struct Row {
  std::string_view path;  // what is in braces at the end stands for all the rest
  std::string_view method;
  Routed (*answer)(const HttpRequest& request, std::string_view rest, Plane& plane);
};

constexpr Row kRoutes[] = {
    {"/status", "GET", GetStatus},
    {"/crane", "POST", PostCrane},
    {"/clamp", "POST", PostClamp},
    {"/reset", "POST", PostReset},
    {"/push", "POST", PostPush},
    {"/remote", "POST", PostRemote},
    {"/pause", "POST", PostPause},
    {"/step", "POST", PostStep},
    {"/speed", "POST", PostSpeed},
    {"/drag", "POST", PostDrag},
    {"/orders", "GET", GetOrders},
    {"/frame", "GET", GetFrame},
    {"/frames", "GET", GetFrames},
    {"/refusals", "GET", GetRefusals},
    {"/timings", "GET", GetTimings},
    {"/metrics", "GET", GetMetrics},
    {"/scene", "GET", GetScene},
    {"/scene/mesh/{index}", "GET", GetMesh},
    {"/scene/hfield/{index}", "GET", GetHeightField},
    {"/scene/model", "GET", GetModel},
    {"/openapi.yaml", "GET", GetOpenApi},
    {"/panel", "GET", GetPanel},
    {"/", "GET", GetIndex},
    {"/panel/{file}", "GET", GetFile},
};

// What `path` has where the row has braces; nullopt where it is not this row's.
std::optional<std::string_view> RestOf(std::string_view path, const Row& row) {
  const std::size_t brace = row.path.find('{');
  if (brace == std::string_view::npos) {
    return path == row.path ? std::optional(std::string_view{}) : std::nullopt;
  }
  if (!path.starts_with(row.path.substr(0, brace))) return std::nullopt;
  return path.substr(brace);
}

bool WantsFrames(const Routed& routed) {
  return std::holds_alternative<FromFrame>(routed) || std::holds_alternative<WatchFrames>(routed);
}

HttpReply NoSuchPath(std::string_view path) {
  constexpr std::size_t kLongest = 64;
  const std::string shown{path.substr(0, kLongest)};
  std::vector<std::string> paths;
  for (const Row& row : kRoutes) paths.emplace_back(row.path);
  return ErrorReply(404, "no path " + shown + DidYouMean(shown, paths));
}

}  // namespace

HttpReply AnswerReply(const emulator::Answer& answer) {
  if (!answer.empty()) return ErrorReply(409, answer);
  return {.body = Text({{"ok", true}})};
}

Routed Route(const HttpRequest& request, Plane& plane) {
  const std::string_view path = PathOf(request);
  for (const Row& row : kRoutes) {
    const auto rest = RestOf(path, row);
    if (!rest) continue;
    if (row.method == request.method) {
      Routed routed = row.answer(request, *rest, plane);
      if (plane.frames == nullptr && WantsFrames(routed)) {
        return ErrorReply(404, "there is nothing to be seen");
      }
      return routed;
    }
    HttpReply reply =
        ErrorReply(405, std::string{path.substr(0, 64)} + " takes " + std::string{row.method} +
                            ", not " + std::string{request.method.substr(0, 32)});
    reply.allow = row.method;
    return reply;
  }
  return NoSuchPath(path);
}

std::vector<RouteName> AllRoutes() {
  std::vector<RouteName> routes;
  for (const Row& row : kRoutes) routes.push_back({.method = row.method, .path = row.path});
  return routes;
}

}  // namespace understudy::server
