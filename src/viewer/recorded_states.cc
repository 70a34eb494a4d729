#include "viewer/recorded_states.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "mjcf/compile.h"
#include "record/truth.h"

namespace understudy::viewer {
namespace {

constexpr char kModelName[] = "model.mjb";
constexpr double kRounding = 1e-6;  // s between what is asked for and what is there

}  // namespace

mjcf::ModelHandle RecordedStates::ReadModel() const {
  const std::vector<std::byte> bytes = truth_.reader().ReadAttachment(kModelName);
  return mjcf::ReadBinaryModel({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                               truth_.reader().path().string() + ", " + kModelName);
}

std::string RecordedStates::robot() const {
  const auto& metadata = truth_.reader().contents().metadata;
  const auto about = metadata.find("understudy");
  if (about == metadata.end()) return {};
  const auto name = about->second.find("name");
  return name == about->second.end() ? "" : name->second;
}

void RecordedStates::Refuse(double time) const {
  const Span& whole = truth_.whole();
  throw SetupError(truth_.reader().path().string() + ": it has no second " + std::to_string(time) +
                   "; it goes from " + std::to_string(whole.from) + " to " +
                   std::to_string(whole.to));
}

RecordedStates::Span RecordedStates::Cut(std::optional<double> from,
                                         std::optional<double> to) const {
  const Span& whole = truth_.whole();
  const Span span{.from = std::max(from.value_or(whole.from), whole.from),
                  .to = std::min(to.value_or(whole.to), whole.to)};
  if (span.from < span.to) return span;
  if (from && to && *from >= *to) {
    throw SetupError("--from " + std::to_string(*from) + " is not before --to " +
                     std::to_string(*to));
  }
  Refuse(from && *from >= whole.to ? *from : to.value_or(whole.to));
}

SceneState RecordedStates::At(std::optional<double> time, std::size_t nq) const {
  const Span& whole = truth_.whole();
  const double at = std::max(time.value_or(whole.to), whole.from);
  if (at > whole.to + kRounding) Refuse(at);
  SceneState last;
  Read({.from = at - record::TruthReader::kLookBack, .to = at + kRounding}, nq,
       [&](const SceneState& state) {
         last = state;
         return true;
       });
  if (last.qpos.empty()) Refuse(at);
  return last;
}

void RecordedStates::Read(const Span& span, std::size_t nq, const Visit& visit, const Tell& tell,
                          double before) const {
  const auto tell_picture = [&tell](record::RecordedEvent event) {
    if (!record::IsForPictures(event.kind)) return;
    tell({.time = event.time, .text = std::move(event.text)});
  };
  truth_.Read(
      span, nq,
      [&visit](record::Truth truth) {
        SceneState state;
        state.step = truth.step;
        state.time = truth.time;
        state.qpos = std::move(truth.qpos);
        return visit(state);
      },
      tell ? record::TruthReader::Tell(tell_picture) : nullptr, before);
}

}  // namespace understudy::viewer
