#include "physics/touch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"
#include "robot/hand_law.h"

namespace understudy::physics {
namespace {

using Weights = std::array<double, Touch::kMostRows>;

// One side of a contact.
struct Press {
  int body = 0;
  Eigen::Vector3d p_W;      // m
  Eigen::Vector3d force_W;  // N, along the normal, on the body
};

// Calls `use` for each side of each contact that has a force and whose body `wanted` wants.
template <typename Wanted, typename Use>
void ForEachPress(const mjModel& model, const mjData& data, Wanted wanted, Use use) {
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    if (contact.efc_address < 0) continue;  // near, and left out of the constraints
    const std::array<int, 2> bodies{model.geom_bodyid[contact.geom1],
                                    model.geom_bodyid[contact.geom2]};
    if (!wanted(bodies[0]) && !wanted(bodies[1])) continue;
    mjtNum wrench[6];  // in the contact's frame, whose first axis leads from geom1 to geom2
    mj_contactForce(&model, &data, i, wrench);
    const Eigen::Vector3d push_W = wrench[0] * mjcf::Vector(contact.frame);
    const Eigen::Vector3d p_W = mjcf::Vector(contact.pos);
    if (wanted(bodies[0])) use(Press{bodies[0], p_W, -push_W});
    if (wanted(bodies[1])) use(Press{bodies[1], p_W, push_W});
  }
}

// Fills in how much each of `count` cells of a side feels of a press at `at`, with the side from
// -half to half. m.
void Weigh(double at, double half, int count, double spread, Weights* weights) {
  for (int i = 0; i < count; ++i) {
    const double off = (at - half * ((2 * i + 1.0) / count - 1)) / spread;
    (*weights)[static_cast<std::size_t>(i)] = std::exp(-off * off / 2);
  }
}

}  // namespace

Touch::Touch(const mjModel& model, const robot::RobotSpec& spec) {
  std::size_t first = 0;
  for (std::size_t hand = 0; hand < spec.hands.size(); ++hand) {
    for (const robot::PadSpec& pad : spec.hands[hand].pads) {
      const int site = pad.site.empty() ? -1 : mj_name2id(&model, mjOBJ_SITE, pad.site.c_str());
      if (site >= 0) {
        pads_.push_back({site, model.site_bodyid[site], first, pad.rows, pad.columns,
                         spec.hands[hand].touch.spread});
        hand_of_body_.resize(static_cast<std::size_t>(model.nbody), -1);
        hand_of_body_[static_cast<std::size_t>(model.site_bodyid[site])] = static_cast<int>(hand);
      }
      first += robot::CellsOf(pad);
    }
  }
}

void Touch::Read(const mjModel& model, const mjData& data, std::span<float> cells) const {
  std::ranges::fill(cells, 0.0F);
  const auto wanted = [this](int body) { return HandOf(body) >= 0; };
  ForEachPress(model, data, wanted, [&](const Press& press) {
    for (const Pad& pad : pads_) {
      if (pad.body != press.body) continue;
      const mjcf::RotationView R_WS(data.site_xmat + 9 * pad.site);
      const Eigen::Vector3d p =
          R_WS.transpose() * (press.p_W - mjcf::Vector(data.site_xpos + 3 * pad.site));
      const double felt = -R_WS.col(2).dot(press.force_W);
      if (felt <= 0 || std::abs(p.z()) > kReach) continue;
      const mjtNum* half = model.site_size + 3 * pad.site;
      Weights across, down;
      Weigh(p.x(), half[0], pad.columns, pad.spread, &across);
      Weigh(-p.y(), half[1], pad.rows, pad.spread, &down);
      float* cell = &cells[pad.first];
      for (int row = 0; row < pad.rows; ++row) {
        for (int column = 0; column < pad.columns; ++column) {
          *cell++ += static_cast<float>(felt * down[static_cast<std::size_t>(row)] *
                                        across[static_cast<std::size_t>(column)]);
        }
      }
    }
  });
}

void Touch::Forces(const mjModel& model, const mjData& data, std::span<double> hands) const {
  std::ranges::fill(hands, 0.0);
  const auto wanted = [this](int body) { return HandOf(body) >= 0; };
  if (pads_.empty()) return;
  ForEachPress(model, data, wanted, [&](const Press& press) {
    hands[static_cast<std::size_t>(HandOf(press.body))] += press.force_W.norm();
  });
}

}  // namespace understudy::physics
