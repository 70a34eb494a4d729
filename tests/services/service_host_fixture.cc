#include "tests/services/service_host_fixture.h"

#include <stdexcept>

namespace understudy::services {

ServiceTable EchoTable(bool needs_motion) {
  const Field text{.key = "a", .type = &kString, .required = true};
  return {
      .name = "echo",
      .title = "echo",
      .api_version = "1.2.3.4",
      .codes = {.unable = 4205},
      .needs_motion = needs_motion,
      .rows = {{.id = 7,
                .name = "Echo",
                .fields = {text},
                .effect = Special{[](const ServiceCall& call) {
                  call.owner->Ask({});
                  return ServiceReply{.data = call.parameter.at("a").get<std::string>()};
                }}},
               {.id = 8, .name = "Fly", .effect = NoController{}},
               {.id = 11, .name = "Look", .effect = GivePicture{}},
               {.id = 9, .name = "Throw", .effect = Special{[](const ServiceCall&) -> ServiceReply {
                                            throw std::runtime_error("oh");
                                          }}},
               {.id = 10, .name = "Wave", .effect = Special{[](const ServiceCall&) {
                                            return ServiceReply{
                                                .once =
                                                    [](const robot::MotionState& state) {
                                                      return state.arm_action == 0 ||
                                                             state.arm_holding;
                                                    },
                                                .patience = std::chrono::seconds(20)};
                                          }}}}};
}

}  // namespace understudy::services
