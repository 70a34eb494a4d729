#include "doctor/vendor_topics.h"

#include <algorithm>

#include "wire/topics.h"

namespace understudy::doctor {
namespace {

constexpr std::string_view kText = "std_msgs::msg::dds_::String_";
constexpr std::string_view kHandCmd = "unitree_hg::msg::dds_::HandCmd_";
constexpr std::string_view kHandState = "unitree_hg::msg::dds_::HandState_";
constexpr std::string_view kServices = "rt/api/";

struct Row {
  std::string_view topic;
  std::string_view type;
};

template <class Msg>
Row Of(const bus::Topic<Msg>& topic) {
  return {topic.name, bus::TypeName(*topic.descriptor)};
}

// docs/sources.md#topics
const std::vector<Row>& Rows() {
  static const std::vector<Row> rows = {
      Of(wire::kGoLowCmd),
      Of(wire::kHgLowCmd),
      Of(wire::kGoLowState),
      Of(wire::kHgLowState),
      Of(wire::kGoLfLowState),
      Of(wire::kHgLfLowState),
      Of(wire::kSecondaryImu),
      Of(wire::kLfSecondaryImu),
      Of(wire::kLfBmsState),
      Of(wire::kSportModeState),
      Of(wire::kHgSportModeState),
      Of(wire::kLfSportModeState),
      Of(wire::kLfHgSportModeState),
      Of(wire::kOdomModeState),
      Of(wire::kLfOdomModeState),
      Of(wire::kGoArmSdk),
      Of(wire::kHgArmSdk),
      Of(wire::kUserLowCmd),
      Of(wire::kLfMainBoardState),
      Of(wire::kArmActionState),
      Of(wire::kErrorList),
      Of(wire::kWirelessController),
      {"rt/config_change_status", "unitree_go::msg::dds_::ConfigChangeStatus_"},
      {"rt/servicestate", kText},
      {"rt/utlidar/switch", kText},
      {"rt/uwbswitch", "unitree_go::msg::dds_::UwbSwitch_"},
      {"rt/rtc/state", kText},
      {"rt/multiplestate", kText},
      {"rt/gnss", kText},
      {"rt/audiohub/player/state", kText},
      {"rt/public_network_status", kText},
      {"rt/dex3/left/cmd", kHandCmd},
      {"rt/dex3/right/cmd", kHandCmd},
      {"rt/dex3/left/state", kHandState},
      {"rt/dex3/right/state", kHandState},
      {"rt/lf/dex3/left/state", kHandState},
      {"rt/lf/dex3/right/state", kHandState},
  };
  return rows;
}

}  // namespace

std::vector<std::string_view> TypesOf(std::string_view topic) {
  if (topic.starts_with(kServices) && topic.ends_with("/request")) {
    return {"unitree_api::msg::dds_::Request_"};
  }
  if (topic.starts_with(kServices) && topic.ends_with("/response")) {
    return {"unitree_api::msg::dds_::Response_"};
  }
  std::vector<std::string_view> types;
  for (const Row& row : Rows()) {
    if (row.topic == topic) types.push_back(row.type);
  }
  return types;
}

std::vector<std::string> VendorTopics() {
  std::vector<std::string> topics;
  for (const Row& row : Rows()) {
    if (std::ranges::find(topics, row.topic) == topics.end()) topics.emplace_back(row.topic);
  }
  return topics;
}

std::string_view FamilyOf(std::string_view type) {
  if (type.starts_with("unitree_go::")) return "go";
  if (type.starts_with("unitree_hg::")) return "hg";
  return "";
}

}  // namespace understudy::doctor
