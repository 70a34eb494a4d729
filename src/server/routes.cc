#include "server/routes.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>

#include "base/nearest_word.h"
#include "server/metrics.h"
#include "server/request_docs.h"
#include "server/snapshot_json.h"

namespace understudy::server {
namespace {

using nlohmann::ordered_json;

constexpr double kLeastHz = 1, kMostHz = 240;  // of snapshots; *assumed*, more than screens show

HttpReply JsonReply(const ordered_json& value) { return {.body = JsonText(value) + "\n"}; }

// Reads a request from a POST.
Routed Posted(const emulator::RequestRow& row, std::string_view body, std::size_t robot) {
  using nlohmann::json;
  try {
    const json values = body.empty() ? json() : json::parse(body);
    if (!values.is_object() && !values.is_null()) {
      return ErrorReply(400,
                        "the body: expected a JSON object, got " + schema::Node(values).shown());
    }
    auto request = emulator::ReadRequest(row, values);
    if (!request) return ErrorReply(400, request.why());
    if (!values.contains(emulator::kRobotField.key)) request->robot = robot;
    return *std::move(request);
  } catch (const json::parse_error& error) {
    return ErrorReply(400, "the body is not JSON, see byte " + std::to_string(error.byte));
  } catch (const json::out_of_range&) {
    return ErrorReply(400, "the body holds a number too large for a double");
  }
}

Routed GetStatus(const HttpRequest&, std::string_view, Plane& plane) {
  plane.events.Update();
  return JsonReply(StatusJson(plane.identity, plane.board->Read(), plane.events));
}

// Returns the requested parts, all by default, or an error.
Result<emulator::SnapshotParts> PartsOf(const HttpRequest& request) {
  const auto list = QueryValue(request, "parts");
  if (!list) return emulator::kAllSnapshotParts;
  std::string unknown;
  if (const auto parts = ReadSnapshotParts(*list, &unknown)) return *parts;
  std::vector<std::string> names;
  for (const emulator::SnapshotPartName& part : emulator::kSnapshotParts)
    names.emplace_back(part.name);
  return Error{"parts: a snapshot has no " + unknown.substr(0, 32) +
               DidYouMean(unknown.substr(0, 32), names)};
}

// Returns the requested snapshots per second.
Result<double> HzOf(const HttpRequest& request) {
  const auto text = QueryValue(request, "hz");
  if (!text) return 60.0;
  double hz = 0;
  const char* const end = text->data() + text->size();
  const bool read = std::from_chars(text->data(), end, hz).ptr == end && !text->empty();
  if (!read || !(hz >= kLeastHz && hz <= kMostHz)) {
    return Error{"hz: expected a number from 1 to 240"};
  }
  return hz;
}

Routed GetSnapshot(const HttpRequest& request, std::string_view, Plane&) {
  const auto parts = PartsOf(request);
  if (!parts) return ErrorReply(400, parts.why());
  return FromSnapshot{
      .parts = *parts,
      .reply = [](const emulator::Snapshot& snapshot, emulator::SnapshotParts asked, Plane&) {
        return HttpReply{.body = SnapshotJson(snapshot, asked) + "\n"};
      }};
}

Routed GetMetrics(const HttpRequest&, std::string_view, Plane&) {
  return FromSnapshot{
      .parts = kMetricsParts,
      .reply = [](const emulator::Snapshot& snapshot, emulator::SnapshotParts, Plane& plane) {
        plane.events.Update();
        return HttpReply{
            .body = MetricsText(plane.identity, plane.board->Read(), snapshot, plane.events),
            .type = kMetricsType};
      }};
}

Routed GetSettings(const HttpRequest&, std::string_view, Plane&) {
  return FromSnapshot{.parts = emulator::kPartSettings,
                      .reply = [](const emulator::Snapshot& snapshot, emulator::SnapshotParts,
                                  Plane&) { return JsonReply(SettingsJson(snapshot)); }};
}

Routed GetFaults(const HttpRequest&, std::string_view, Plane&) {
  return FromSnapshot{.parts = emulator::kPartFaults,
                      .reply = [](const emulator::Snapshot& snapshot, emulator::SnapshotParts,
                                  Plane&) { return JsonReply(FaultsJson(snapshot)); }};
}

Routed GetTimings(const HttpRequest&, std::string_view, Plane& plane) {
  return JsonReply(TimingsJson(plane.board->Read()));
}

// Read at each request: the document is small and rarely requested.
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

Routed GetSnapshots(const HttpRequest& request, std::string_view, Plane&) {
  const auto parts = PartsOf(request);
  if (!parts) return ErrorReply(400, parts.why());
  const auto hz = HzOf(request);
  if (!hz) return ErrorReply(400, hz.why());
  if (!request.upgrade) return UpgradeRequired("/snapshots");
  return WatchSnapshots{.parts = *parts, .hz = *hz};
}

// What /status already shows must not be missing here, so the answer does not wait for the timer.
Routed GetEvents(const HttpRequest& request, std::string_view, Plane& plane) {
  if (request.upgrade) return WatchEvents{};
  plane.events.Update();
  return JsonReply(EventsJson(plane.events));
}

Routed GetRequests(const HttpRequest& request, std::string_view, Plane&) {
  if (request.upgrade) return TakeRequests{};
  return JsonReply(RequestsJson());
}

Routed GetBus(const HttpRequest&, std::string_view, Plane& plane) { return plane.bus.Get(); }

Routed GetServices(const HttpRequest&, std::string_view, Plane& plane) {
  ordered_json services = ordered_json::array();
  for (const services::ServiceTable& table : plane.services) {
    ordered_json apis = ordered_json::array();
    for (const services::ApiRow& row : table.rows) {
      apis.push_back({{"id", row.id}, {"name", row.name}, {"does", row.does}});
    }
    services.push_back({{"name", table.name}, {"apis", apis}});
  }
  return JsonReply({{"services", services}});
}

Routed GetRecordings(const HttpRequest&, std::string_view, Plane& plane) {
  return plane.recordings.List();
}

Routed GetRecording(const HttpRequest& request, std::string_view name, Plane& plane) {
  return plane.recordings.Show(request, name);
}

std::span<const robot::CameraSpec> CamerasOf(const Plane& plane) {
  return plane.views == nullptr ? std::span<const robot::CameraSpec>() : plane.views->cameras();
}

Routed GetCameras(const HttpRequest&, std::string_view, Plane& plane) {
  ordered_json cameras = ordered_json::array();
  const auto specs = CamerasOf(plane);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const robot::CameraSpec& camera = specs[i];
    const VideoCounts video = plane.views->video(i);
    cameras.push_back({{"name", camera.name},
                       {"service", camera.service},
                       {"width", robot::PictureWidth(camera)},
                       {"height", camera.height},
                       {"depth", robot::HasDepth(camera)},
                       {"video",
                        {{"port", camera.video_port},
                         {"sent", video.sent},
                         {"missed", video.missed},
                         {"unsent_packets", video.unsent}}}});
  }
  return JsonReply({{"cameras", cameras}});
}

template <bool kDepth>
Routed GetCamera(const HttpRequest&, std::string_view name, Plane& plane) {
  const auto cameras = CamerasOf(plane);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    names.push_back(cameras[i].name);
    if (cameras[i].name != name) continue;
    if (!kDepth || robot::HasDepth(cameras[i])) return FromCamera{.camera = i, .depth = kDepth};
    return ErrorReply(404, "the camera " + cameras[i].name + " measures no depth");
  }
  const std::string shown{name.substr(0, 64)};
  return ErrorReply(404, names.empty() ? "this robot has no camera"
                                       : "no camera " + shown + DidYouMean(shown, names));
}

Routed GetLidar(const HttpRequest&, std::string_view, Plane& plane) { return plane.sight.List(); }

Routed GetLidarView(const HttpRequest&, std::string_view name, Plane& plane) {
  return plane.sight.Get(name);
}

template <auto kMake>
Routed FromScene(const HttpRequest&, std::string_view index, Plane& plane) {
  if (!plane.scene) return ErrorReply(404, "there is no scene");
  if constexpr (std::is_invocable_v<decltype(kMake), SceneFiles&>) {
    return std::invoke(kMake, *plane.scene);
  } else {
    return std::invoke(kMake, *plane.scene, index);
  }
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
  ordered_json robots = ordered_json::array();
  for (const RobotPanel& one : plane.robots) {
    robots.push_back({{"name", one.name}, {"url", one.url}});
  }
  return JsonReply({{"url", plane.url}, {"robots", robots}});
}

// The routes of GET; the POSTs are those of the table of requests.
struct Row {
  std::string_view path;  // braces match a part of a path, to its end or to what follows them
  Routed (*answer)(const HttpRequest& request, std::string_view rest, Plane& plane);
};

constexpr Row kRoutes[] = {
    {"/status", GetStatus},
    {"/requests", GetRequests},
    {"/settings", GetSettings},
    {"/faults", GetFaults},
    {"/snapshot", GetSnapshot},
    {"/snapshots", GetSnapshots},
    {"/events", GetEvents},
    {"/bus", GetBus},
    {"/services", GetServices},
    {"/recordings", GetRecordings},
    {"/recordings/{name}", GetRecording},
    {"/cameras", GetCameras},
    {"/cameras/{name}/depth", GetCamera<true>},
    {"/cameras/{name}", GetCamera<false>},
    {"/lidar", GetLidar},
    {"/lidar/{name}", GetLidarView},
    {"/timings", GetTimings},
    {"/metrics", GetMetrics},
    {"/scene", FromScene<&SceneFiles::Scene>},
    {"/scene/mesh/{index}", FromScene<&SceneFiles::Mesh>},
    {"/scene/hfield/{index}", FromScene<&SceneFiles::HeightField>},
    {"/scene/model", FromScene<&SceneFiles::Model>},
    {"/openapi.yaml", GetOpenApi},
    {"/panel", GetPanel},
    {"/", GetIndex},
    {"/panel/{file}", GetFile},
};

// Returns the part of `path` that matches the braces; nullopt if the row does not match.
std::optional<std::string_view> RestOf(std::string_view path, const Row& row) {
  const std::size_t brace = row.path.find('{');
  if (brace == std::string_view::npos) {
    return path == row.path ? std::optional(std::string_view{}) : std::nullopt;
  }
  const std::string_view after = row.path.substr(row.path.find('}') + 1);
  if (path.size() < brace + after.size() || !path.starts_with(row.path.substr(0, brace)) ||
      !path.ends_with(after)) {
    return std::nullopt;
  }
  return path.substr(brace, path.size() - brace - after.size());
}

HttpReply WrongMethod(const HttpRequest& request, std::string_view right) {
  HttpReply reply =
      ErrorReply(405, std::string{PathOf(request).substr(0, 64)} + " takes " + std::string{right} +
                          ", not " + std::string{request.method.substr(0, 32)});
  reply.allow = right;
  return reply;
}

bool WantsSnapshots(const Routed& routed) {
  return std::holds_alternative<FromSnapshot>(routed) ||
         std::holds_alternative<WatchSnapshots>(routed);
}

HttpReply NoSuchPath(std::string_view path) {
  constexpr std::size_t kLongest = 64;
  const std::string shown{path.substr(0, kLongest)};
  std::vector<std::string> paths;
  for (const RouteName& route : AllRoutes()) paths.push_back(route.path);
  return ErrorReply(404, "no path " + shown + DidYouMean(shown, paths));
}

}  // namespace

HttpReply AnswerReply(const emulator::Answer& answer) {
  if (!answer) return ErrorReply(409, answer.why());
  return JsonReply({{"ok", true}});
}

Routed Route(const HttpRequest& request, Plane& plane) {
  const std::string_view path = PathOf(request);
  for (const Row& row : kRoutes) {
    const auto rest = RestOf(path, row);
    if (!rest) continue;
    if (request.method != "GET") return WrongMethod(request, "GET");
    Routed routed = row.answer(request, *rest, plane);
    if (plane.snapshots == nullptr && WantsSnapshots(routed)) {
      return ErrorReply(404, "there is nothing to be seen");
    }
    return routed;
  }
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    if (path != RequestPath(row)) continue;
    return request.method == "POST" ? Posted(row, request.body, plane.robot)
                                    : WrongMethod(request, "POST");
  }
  return NoSuchPath(path);
}

std::vector<RouteName> AllRoutes() {
  std::vector<RouteName> routes;
  for (const Row& row : kRoutes) routes.push_back({"GET", std::string(row.path)});
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    routes.push_back({"POST", RequestPath(row)});
  }
  return routes;
}

}  // namespace understudy::server
