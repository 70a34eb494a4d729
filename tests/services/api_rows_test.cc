// Tests every row of every table of services.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/api_names.h"
#include "services/parameter.h"
#include "services/robot_services.h"
#include "tests/services/services_fixture.h"

namespace understudy::services {
namespace {

using nlohmann::json;

json GoodValue(const Field& field) {
  const double low = std::isfinite(field.range.min) ? field.range.min : 0;
  const double high = std::isfinite(field.range.max) ? field.range.max : low;
  const json point = {{"t_from_start", 0.1}, {"x", 0.0}, {"y", 0.0}, {"yaw", 0.0}};
  const std::size_t count = std::max<std::size_t>(field.count, 1);
  if (field.type == &kBool || field.type == &kFlag) return true;
  if (field.type == &schema::kWhole) return static_cast<std::int64_t>(high);
  if (field.type == &schema::kNumber) return (low + high) / 2;
  if (field.type == &schema::kNumbers) return json(std::vector<double>(count, low));
  if (field.type == &kPath) return json(std::vector<json>(count, point));
  return "name";
}

json GoodParameter(const ApiRow& row) {
  if (!row.fields.empty() && row.fields.front().key.empty()) return GoodValue(row.fields.front());
  json object = json::object();
  for (const Field& field : row.fields) object[std::string(field.key)] = GoodValue(field);
  return object;
}

// What no field takes for its own.
json WrongValue(const Field& field) { return field.type == &kString ? json(7) : json("seven"); }

// The largest number that a client has put into a goal, of those that are clamped.
double Largest(const authority::MotionGoal& goal) {
  if (const auto* euler = std::get_if<authority::goal::Euler>(&goal)) {
    return std::max({std::abs(euler->roll), std::abs(euler->pitch), std::abs(euler->yaw)});
  }
  if (const auto* move = std::get_if<authority::goal::Move>(&goal)) {
    return std::max({std::abs(move->vx), std::abs(move->vy), std::abs(move->yaw_rate)});
  }
  if (const auto* body = std::get_if<authority::goal::BodyHeight>(&goal)) {
    return std::abs(body->height);
  }
  if (const auto* raise = std::get_if<authority::goal::FootRaise>(&goal)) {
    return std::abs(raise->over);
  }
  if (const auto* stand = std::get_if<authority::goal::SetStandHeight>(&goal)) {
    return std::abs(stand->height);
  }
  return HUGE_VAL;
}

bool IsList(const ApiRow& row) { return !row.fields.empty() && row.fields.front().key.empty(); }

// Calls check(caller, table, row) for each row of each table, with a fresh robot and service each.
template <typename Check>
void ForEachRow(Check check) {
  for (const std::string_view name : kApiNames) {
    const ServiceTable table = TableNamed(name);
    for (const ApiRow& row : table.rows) {
      SCOPED_TRACE(std::string(name) + " " + std::string(row.name));
      Caller caller(table);
      check(&caller, table, row);
    }
  }
}

std::int32_t ParameterCode(const ServiceTable& table, const ApiRow& row) {
  return row.parameter_code.value_or(table.parameter_code);
}

TEST(ApiRowsTest, AnswerEveryApiOfTheVendorsHeadersAndThoseSeenOnItsRobots) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/tests/data/vendor_apis.json");
  for (const json& vendor : json::parse(file)) {
    const auto service = vendor.at("service").get<std::string>();
    std::vector<ServiceTable> tables;
    for (const auto& robot : vendor.at("robots")) {
      tables.push_back(TableOf(robot.get<std::string>(), service));
    }
    for (const auto& name : vendor.value("tables", json::array())) {  // of another firmware
      tables.push_back(TableNamed(name.get<std::string>()));
    }
    for (const ServiceTable& table : tables) {
      EXPECT_EQ(table.name, service);
      SCOPED_TRACE(std::string(table.title));
      std::set<std::int64_t> ours, theirs;
      for (const ApiRow& row : table.rows) ours.insert(row.id);
      for (const json& api : vendor.at("apis")) theirs.insert(api.at(0).get<std::int64_t>());
      for (const json& api : vendor.value("seen", json::array())) {
        theirs.insert(api.at(0).get<std::int64_t>());
      }
      // What a robot refused although its header has it.
      for (const json& id : vendor.value("refused", json::array())) {
        theirs.erase(id.get<std::int64_t>());
      }
      EXPECT_EQ(ours, theirs);
      const auto& versions = vendor.at("versions");
      EXPECT_NE(std::find(versions.begin(), versions.end(), table.api_version), versions.end())
          << table.api_version;
    }
  }
}

TEST(ApiRowsTest, HaveNamesDocumentationAndSources) {
  ForEachRow([](Caller*, const ServiceTable&, const ApiRow& row) {
    EXPECT_FALSE(row.name.empty());
    EXPECT_FALSE(row.does.empty());
    EXPECT_FALSE(row.source.empty());
  });
}

TEST(ApiRowsTest, TakeAGoodParameterOrSayThatNothingHerePlaysIt) {
  ForEachRow([](Caller* caller, const ServiceTable&, const ApiRow& row) {
    const ServiceReply reply = caller->Ask(row.id, GoodParameter(row).dump());
    EXPECT_NE(reply.code, kRpcApiNotImplemented);
    EXPECT_NE(reply.code, kRpcServerInternal) << caller->notice;
    EXPECT_EQ(reply.picture, std::holds_alternative<GivePicture>(row.effect));
    if (std::holds_alternative<NoController>(row.effect) || reply.picture) {
      EXPECT_NE(reply.code, 0);
      EXPECT_EQ(reply.refusal, CallRefusal::kNotSimulated);
      EXPECT_TRUE(caller->robot.book.goals.empty());
    } else if (!std::holds_alternative<Special>(row.effect)) {
      EXPECT_EQ(reply.code, 0);
    }
  });
}

TEST(ApiRowsTest, AskTheMotionServiceForWhatTheySay) {
  ForEachRow([](Caller* caller, const ServiceTable&, const ApiRow& row) {
    const auto* ask = std::get_if<AskGoal>(&row.effect);
    if (ask == nullptr) return;
    caller->Ask(row.id, GoodParameter(row).dump());
    ASSERT_EQ(caller->robot.book.goals.size(), 1U);
    EXPECT_EQ(caller->robot.book.goals.front().index(), ask->goal({1}).index());
  });
}

TEST(ApiRowsTest, SayThatAGoalCannotBePlayedInsteadOfClaimingIt) {
  ForEachRow([](Caller* caller, const ServiceTable&, const ApiRow& row) {
    if (!std::holds_alternative<AskGoal>(row.effect)) return;
    caller->robot.book.verdict = authority::MotionVerdict::kUnable;
    const ServiceReply reply = caller->Ask(row.id, GoodParameter(row).dump());
    EXPECT_NE(reply.code, 0);
    EXPECT_EQ(reply.refusal, CallRefusal::kNotSimulated);
  });
}

// Robots answer some of these with 0, as they do what they did.
TEST(ApiRowsTest, SayWhyTheMotionServiceDidNothingAlsoWhereTheAnswerIsZero) {
  using authority::MotionVerdict;
  ForEachRow([](Caller* caller, const ServiceTable&, const ApiRow& row) {
    if (!std::holds_alternative<AskGoal>(row.effect)) return;
    const std::string parameter = GoodParameter(row).dump();
    EXPECT_EQ(caller->Ask(row.id, parameter).refusal, CallRefusal::kNone);
    caller->robot.book.verdict = MotionVerdict::kNotNow;
    EXPECT_EQ(caller->Ask(row.id, parameter).refusal, CallRefusal::kState);
    caller->robot.book.verdict = MotionVerdict::kUnknown;
    EXPECT_EQ(caller->Ask(row.id, parameter).refusal, CallRefusal::kGoal);
  });
}

TEST(ApiRowsTest, SayWhyForEveryCodeButZero) {
  using authority::MotionVerdict;
  ForEachRow([](Caller* caller, const ServiceTable&, const ApiRow& row) {
    for (const MotionVerdict verdict :
         {MotionVerdict::kTaken, MotionVerdict::kIgnored, MotionVerdict::kNotNow,
          MotionVerdict::kUnknown, MotionVerdict::kUnable}) {
      caller->robot.book.verdict = verdict;
      for (const std::string& parameter : {GoodParameter(row).dump(), std::string("{")}) {
        const ServiceReply reply = caller->Ask(row.id, parameter);
        EXPECT_TRUE(reply.code == kRpcOk || reply.refusal != CallRefusal::kNone) << reply.code;
      }
    }
    EXPECT_EQ(caller->Ask(-1).refusal, CallRefusal::kUnknownApi);
  });
}

TEST(ApiRowsTest, AnswerGettersWithJson) {
  ForEachRow([](Caller* caller, const ServiceTable&, const ApiRow& row) {
    if (!OnlyReads(row) || !row.fields.empty()) return;
    if (std::holds_alternative<GivePicture>(row.effect)) return;
    for (const char* parameter : {"", "{}"}) {
      const ServiceReply reply = caller->Ask(row.id, parameter);
      EXPECT_FALSE(json::parse(reply.data, nullptr, false).is_discarded()) << reply.data;
    }
  });
}

TEST(ApiRowsTest, RefuseAParameterThatIsMissing) {
  ForEachRow([](Caller* caller, const ServiceTable& table, const ApiRow& row) {
    for (const Field& field : row.fields) {
      if (!field.required || IsList(row)) continue;
      json parameter = GoodParameter(row);
      parameter.erase(std::string(field.key));
      EXPECT_EQ(caller->Ask(row.id, parameter.dump()).code, ParameterCode(table, row));
    }
  });
}

TEST(ApiRowsTest, RefuseAParameterOfAnotherType) {
  ForEachRow([](Caller* caller, const ServiceTable& table, const ApiRow& row) {
    for (const Field& field : row.fields) {
      json parameter = GoodParameter(row);
      (IsList(row) ? parameter : parameter[std::string(field.key)]) = WrongValue(field);
      EXPECT_EQ(caller->Ask(row.id, parameter.dump()).code, ParameterCode(table, row));
    }
  });
}

TEST(ApiRowsTest, RefuseOrClampWhatIsOutOfRange) {
  ForEachRow([](Caller* caller, const ServiceTable& table, const ApiRow& row) {
    for (const Field& field : row.fields) {
      if (!std::isfinite(field.range.max)) continue;
      json parameter = GoodParameter(row);
      parameter[std::string(field.key)] = field.range.max + 1000;
      const std::int32_t code = caller->Ask(row.id, parameter.dump()).code;
      if (!field.clamped) {
        EXPECT_EQ(code, ParameterCode(table, row)) << field.key;
      } else {
        EXPECT_NE(code, ParameterCode(table, row)) << field.key;
        for (const authority::MotionGoal& goal : caller->robot.book.goals) {
          EXPECT_LT(Largest(goal), 999);
        }
      }
    }
  });
}

TEST(ApiRowsTest, RefuseGarbage) {
  const std::string deep(10000, '[');
  ForEachRow([&](Caller* caller, const ServiceTable& table, const ApiRow& row) {
    const bool needs = std::ranges::any_of(row.fields, [](const auto& f) { return f.required; });
    if (!needs) return;
    for (const std::string_view bytes :
         {std::string_view("{"), std::string_view(deep), std::string_view("\xff\xfe"),
          std::string_view("nan"), std::string_view("[1,2]"), std::string_view("null"),
          std::string_view("\"ai\""), std::string_view("{}"), std::string_view("")}) {
      EXPECT_EQ(caller->Ask(row.id, bytes).code, ParameterCode(table, row)) << bytes.substr(0, 9);
    }
  });
}

TEST(ApiRowsTest, RefuseWhatIsTooLong) {
  ForEachRow([](Caller* caller, const ServiceTable& table, const ApiRow& row) {
    ServiceRequest request{.api_id = row.id, .parameter_bytes = 1 << 20};
    std::string notice;
    EXPECT_EQ(caller->service.Answer(request, &caller->robot.owner, caller->now, &notice).code,
              ParameterCode(table, row));
    request.parameter_bytes = 0;
    request.binary_bytes = 1 << 20;
    EXPECT_EQ(caller->service.Answer(request, &caller->robot.owner, caller->now, &notice).code,
              ParameterCode(table, row));
  });
}

TEST(ApiRowsTest, SurviveEveryOtherRobotsParameters) {
  std::vector<std::string> parameters;
  ForEachRow([&](Caller*, const ServiceTable&, const ApiRow& row) {
    parameters.push_back(GoodParameter(row).dump());
  });
  ForEachRow([&](Caller* caller, const ServiceTable& table, const ApiRow& row) {
    for (std::size_t i = 0; i < parameters.size(); i += 7) {
      const std::int32_t code = caller->Ask(row.id, parameters[i]).code;
      if (ParameterCode(table, row) == kRpcServerInternal) {
        EXPECT_EQ(caller->notice, "");
      } else {
        EXPECT_NE(code, kRpcServerInternal) << caller->notice;
      }
    }
  });
}

}  // namespace
}  // namespace understudy::services
