#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "identify/identify.h"
#include "identify/uncertainty.h"

namespace understudy::identify {
namespace {

constexpr double kSure = 0.95;  // of the printed intervals

std::string Names(std::span<const Samples> recordings) {
  std::string names;
  for (const Samples& samples : recordings) {
    names += (names.empty() ? "" : ", ") + std::filesystem::path(samples.file).filename().string();
  }
  return names;
}

std::string FitText(const char* what, const Fit& fit) {
  if (fit.windows == 0) return "";
  return fmt::format("{:<10} {:>5} windows: rms of q {:.5f} rad before, {:.5f} after\n", what,
                     fit.windows, fit.before, fit.after);
}

nlohmann::json FitJson(const Fit& fit) {
  return {{"windows", fit.windows}, {"rms_before", fit.before}, {"rms_after", fit.after}};
}

}  // namespace

double Found::Bar(double probability) const {
  return StudentQuantile(probability, freedom) * error;
}

std::string ResultText(const Identification& result, std::span<const Samples> recordings) {
  std::string text = fmt::format("{}, in windows of {} s\n\n{:<24} {:>10} {:>10} {:>12} {:>12}\n",
                                 Names(recordings), result.window, "", "before", "after",
                                 "std. error", "95 %: +-");
  for (const Found& found : result.found) {
    if (!found.told) continue;
    text += fmt::format("{:<24} {:>10.4g} {:>10.4g} {:>12.2g} {:>12.2g} {}\n", found.name,
                        found.parameter.before, found.value, found.error, found.Bar(kSure),
                        found.parameter.quantity->unit);
  }
  text += "\n" + FitText("fitted", result.fitted) + FitText("held out", result.held_out);
  for (const Correlated& pair : result.correlated) {
    text += fmt::format("{} and {} hang together: {:.2f}\n", pair.first, pair.second, pair.by);
  }
  for (const Found& found : result.found) {
    if (!found.told) text += fmt::format("not told: {}: {}\n", found.name, found.why);
  }
  return text;
}

std::string ResultJson(const Identification& result, std::span<const Samples> recordings) {
  nlohmann::json json{{"window", result.window},
                      {"fitted", FitJson(result.fitted)},
                      {"held_out", FitJson(result.held_out)},
                      {"recordings", nlohmann::json::array()},
                      {"figures", nlohmann::json::array()},
                      {"correlated", nlohmann::json::array()}};
  for (const Samples& samples : recordings) json["recordings"].push_back(samples.file);
  for (const Found& found : result.found) {
    const double bar = found.told ? found.Bar(kSure) : 0;
    json["figures"].push_back(
        {{"name", found.name},
         {"unit", found.parameter.quantity->unit},
         {"before", found.parameter.before},
         {"told", found.told},
         {"value", found.value},
         {"standard_error", found.told ? nlohmann::json(found.error) : nullptr},
         {"freedom", found.told ? nlohmann::json(found.freedom) : nullptr},
         {"interval_95", found.told ? nlohmann::json{found.value - bar, found.value + bar}
                                    : nlohmann::json(nullptr)},
         {"why", found.why}});
  }
  for (const Correlated& pair : result.correlated) {
    json["correlated"].push_back({{"figures", {pair.first, pair.second}}, {"by", pair.by}});
  }
  return json.dump(2) + "\n";
}

std::string ResultYaml(const Identification& result, const Basis& basis,
                       std::span<const Samples> recordings) {
  std::vector<Parameter> kept;
  std::vector<double> values;
  std::string yaml = fmt::format(
      "# Fitted by `understudy identify` to {}: rms of q {:.5f} rad before, {:.5f} after",
      Names(recordings), result.fitted.before, result.fitted.after);
  if (result.held_out.windows > 0) {
    yaml += fmt::format(";\n# held out {:.5f} before, {:.5f} after", result.held_out.before,
                        result.held_out.after);
  }
  yaml += ".\n";
  bool moved_gains = false, moved_mass = false;
  for (const Found& found : result.found) {
    if (!found.told) continue;
    kept.push_back(found.parameter);
    values.push_back(found.value);
    moved_gains = moved_gains || found.parameter.quantity->motor != nullptr;
    moved_mass = moved_mass || found.parameter.quantity->name == "mass";
    yaml += fmt::format("# {} {:.5g}, standard error {:.2g}, with 95 % within {:.2g}\n", found.name,
                        found.value, found.error, found.Bar(kSure));
  }
  const Figures figures = basis.With(kept, values);
  const robot::DynamicsSpec& dynamics = figures.spec.dynamics;
  yaml += "robot:\n  dynamics:\n    use: fitted\n    fitted:\n";
  for (std::size_t i = 0; i < dynamics.fitted.size(); ++i) {
    const robot::FittedDynamicsSpec& row = dynamics.fitted[i];
    yaml += fmt::format(
        "      - {{slots: [{}], armature: {:.6g}, damping: {:.6g}, frictionloss: {:.6g}, "
        "kd_share: {:.6g}}}  # {}\n",
        fmt::join(row.slots, ", "), row.armature, row.damping, row.frictionloss, row.kd_share,
        basis.groups[i].name);
  }
  yaml += fmt::format("    delay: {:.5g}\n", std::max(0.0, figures.delay));
  yaml += "  motors:\n";
  for (const robot::MotorSpec& motor : figures.spec.motors) {
    yaml += fmt::format("    {}: {{armature: 0", motor.joint);  // its row has it
    if (moved_gains) yaml += fmt::format(", kp_scale: {:.6g}", motor.kp_scale);
    yaml += "}\n";
  }
  if (!moved_mass) return yaml;
  yaml += "  bodies:\n";
  for (std::size_t i = 0; i < basis.links.size(); ++i) {
    const physics::BodyFigures& link = basis.links[i];
    std::vector<double> inertia = link.inertia;
    for (double& one : inertia) one *= figures.mass[i];
    yaml += fmt::format("    - {{name: {}, mass: {:.6g}, com: [{:.6g}], inertia: [{:.6g}]}}\n",
                        link.name, figures.mass[i] * link.mass, fmt::join(link.com, ", "),
                        fmt::join(inertia, ", "));
  }
  return yaml;
}

}  // namespace understudy::identify
