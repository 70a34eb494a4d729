// The first byte chooses a service of all robots', the second an api of it; the rest is the
// parameter. The same bytes are read as a serialized request.
#include "services/request.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "services/api_names.h"
#include "services/robot_services.h"
#include "services/service.h"
#include "tests/services/services_fixture.h"

namespace understudy::services {
namespace {

std::vector<std::unique_ptr<Service>> AllServices() {
  std::vector<std::unique_ptr<Service>> all;
  for (const std::string_view name : kApiNames) {
    all.push_back(std::make_unique<Service>(TableNamed(name)));
  }
  return all;
}

void Try(const std::uint8_t* data, std::size_t size) {
  if (const auto view = ReadRequest(std::as_bytes(std::span(data, size)))) {
    if (view->parameter.size() > size) std::abort();
  }
  if (size < 2) return;
  static std::vector<std::unique_ptr<Service>> services = AllServices();
  static ServedRobot robot;
  Service& service = *services[data[0] % services.size()];
  const auto& rows = service.table().rows;
  // One more than there are: none.
  const std::size_t row = data[1] % (rows.size() + 1);
  const std::string_view parameter(reinterpret_cast<const char*>(data) + 2, size - 2);
  robot.book.goals.clear();
  robot.book.verdict = static_cast<authority::MotionVerdict>(data[1] / 64);
  std::string notice;
  const ServiceReply reply = service.Answer({.api_id = row < rows.size() ? rows[row].id : -1,
                                             .parameter = parameter,
                                             .parameter_bytes = parameter.size()},
                                            &robot.owner, Lease::Time(0), &notice);
  // Carrying it out threw, or something is refused silently.
  if (reply.refusal == CallRefusal::kFailed) std::abort();
  if (reply.code != kRpcOk && reply.refusal == CallRefusal::kNone) std::abort();
}

}  // namespace
}  // namespace understudy::services

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  understudy::services::Try(data, size);
  return 0;
}
