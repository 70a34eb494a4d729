#include "authority/chord.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "robot/remote_keys.h"

namespace understudy::authority {
namespace {

constexpr const char* kDebug = "debug";

struct Word {
  const char* word;
  GoalMaker goal;
};

constexpr std::array kWords = {
    Word{"zero_torque", To<goal::ZeroTorque>},
    Word{"damp", To<goal::Damp>},
    Word{"stand_up", To<goal::StandUp>},
    Word{"stand_down", To<goal::StandDown>},
    Word{"balance_stand", To<goal::BalanceStand>},
    Word{"recovery_stand", To<goal::RecoveryStand>},
    Word{"sit", To<goal::Sit>},
    Word{"hello", To<goal::GestureName::kHello>},
    Word{"stretch", To<goal::GestureName::kStretch>},
    Word{"dance1", To<goal::GestureName::kDance1>},
    Word{"heart", To<goal::GestureName::kHeart>},
    Word{"free_walk", To<goal::GaitName::kFree>},
    Word{"static_walk", To<goal::GaitName::kStatic>},
    Word{"trot_run", To<goal::GaitName::kRun>},
    Word{"classic_walk", To<goal::GaitName::kClassic>},
    Word{"economic_gait", To<goal::GaitName::kEconomic>},
    Word{"trot", To<goal::GaitName::kTrot>},
    Word{"stairs", To<goal::GaitName::kStairs>},
    Word{"set_fsm", To<goal::SetFsm>},
    Word{"balance_mode", To<goal::SetBalanceMode>},
    Word{"arm_action", To<goal::ArmAction>},
};

}  // namespace

const std::vector<std::string>& ChordActions() {
  static const std::vector<std::string> kActions = [] {
    std::vector<std::string> actions{kDebug};
    for (const Word& word : kWords) actions.emplace_back(word.word);
    return actions;
  }();
  return kActions;
}

Chord MakeChord(const robot::ChordSpec& spec, const std::string& where) {
  Chord chord;
  chord.clicks = spec.clicks;
  const std::optional<std::uint16_t> keys = robot::RemoteKeys(spec.keys);
  if (!keys) {
    throw ConfigError(where + ".keys: expected keys joined by +, as in L2+B, got '" + spec.keys +
                      "'");
  }
  chord.keys = *keys;
  if (spec.does != kDebug) {
    const auto word = std::find_if(kWords.begin(), kWords.end(),
                                   [&](const Word& w) { return spec.does == w.word; });
    if (word == kWords.end()) {
      throw ConfigError(where + ".does: unknown word '" + spec.does + "'" +
                        DidYouMean(spec.does, ChordActions()));
    }
    chord.goal = word->goal({spec.value});
  }
  chord.from = spec.from;
  return chord;
}

const Chord* ChordReader::Read(std::uint16_t keys, int state, double t) {
  const bool pressed = (keys & ~down_) != 0;
  down_ = keys;
  missed_ = nullptr;
  if (!pressed) return nullptr;
  const int clicks = keys == last_ && t - last_at_ <= kDoubleClick ? 2 : 1;
  last_ = clicks == 1 ? keys : 0;
  last_at_ = t;
  for (const Chord& chord : chords_) {
    if (chord.keys != keys || chord.clicks != clicks) continue;
    const bool fits =
        chord.from.empty() || std::ranges::find(chord.from, state) != chord.from.end();
    if (fits) {
      missed_ = nullptr;
      return &chord;
    }
    missed_ = &chord;
  }
  return nullptr;
}

bool ChordReader::knows_debug() const {
  return std::any_of(chords_.begin(), chords_.end(), [](const Chord& c) { return !c.goal; });
}

}  // namespace understudy::authority
