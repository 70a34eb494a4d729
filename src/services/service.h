// A request/response service of the robot: rt/api/<name>/request and /response.
#ifndef UNDERSTUDY_SERVICES_SERVICE_H_
#define UNDERSTUDY_SERVICES_SERVICE_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy {

// What services may know and change of the robot.
struct RobotMode {
  std::string motion_service;  // the one that moves the motors; "" when LowCmd does
  bool silent = false;         // do not start a motion service at boot
};

// Codes of the vendor's RPC layer (sdk_surface.md, section 3).
inline constexpr std::int32_t kRpcOk = 0;
inline constexpr std::int32_t kRpcServerInternal = 3202;
inline constexpr std::int32_t kRpcApiNotImplemented = 3203;
inline constexpr std::int32_t kRpcApiParameter = 3204;

struct ServiceReply {
  std::int32_t code = kRpcOk;
  std::string data{};  // JSON, or "" where the vendor's clients ignore it
};

class Service {
 public:
  virtual ~Service() = default;

  virtual std::string_view name() const = 0;         // "motion_switcher"
  virtual std::string_view api_version() const = 0;  // what internal api 1 answers

  // Answers api `api_id` with its parameter as sent: JSON, or "" or "{}" where there is none; any
  // bytes may come. nullopt when the service has no such api. Called in the tick's thread: long
  // actions are begun here, not done.
  virtual std::optional<ServiceReply> Handle(std::int64_t api_id, std::string_view parameter,
                                             RobotMode* mode) = 0;
};

}  // namespace understudy

#endif  // UNDERSTUDY_SERVICES_SERVICE_H_
