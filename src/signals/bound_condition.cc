#include "signals/bound_condition.h"

#include <algorithm>
#include <utility>

#include "judge/condition.h"

namespace understudy::signals {
namespace {

using judge::Comparison;
using judge::Condition;
using judge::Formula;
using judge::Leaf;
using judge::Relation;

judge::Compare CompareOf(Relation relation) {
  switch (relation) {
    case Relation::kBelow:
      return judge::Compare::kBelow;
    case Relation::kAtMost:
      return judge::Compare::kAtMost;
    case Relation::kAbove:
      return judge::Compare::kAbove;
    case Relation::kAtLeast:
      return judge::Compare::kAtLeast;
    case Relation::kIs:
      return judge::Compare::kEqual;
    case Relation::kNear:
      return judge::Compare::kNear;
    case Relation::kHappens:
    case Relation::kArrives:
    case Relation::kPrints:
      break;
  }
  return judge::Compare::kTrue;
}

// Switches are numbers in the events, all other words are words.
double NumberOf(const std::string& word) {
  if (word == "true" || word == "on") return 1;
  if (word == "false" || word == "off") return 0;
  return judge::WordNumber(word);
}

class Binder {
 public:
  Binder(const Names& names, std::vector<Signal>* signals) : names_(names), signals_(signals) {}

  Result<Formula> Bind(const Condition& condition) {
    using Kind = Condition::Kind;
    if (condition.kind == Kind::kComparison) return BindLeaf(condition.comparison);
    Formula formula{.op = condition.kind == Kind::kNot   ? judge::Op::kNot
                          : condition.kind == Kind::kAll ? judge::Op::kAll
                                                         : judge::Op::kAny};
    for (const Condition& part : condition.parts) {
      Result<Formula> bound = Bind(part);
      if (!bound) return bound;
      formula.parts.push_back(*std::move(bound));
    }
    return formula;
  }

  std::vector<LeafText> leaves;

 private:
  Result<Formula> BindLeaf(const Comparison& comparison) {
    auto found = FindSignal(comparison, names_);
    if (!found) return found.error();
    const auto scale = ScaleTo(comparison.unit, found->unit);
    if (!scale) return Error{comparison.subject + ": " + scale.why()};
    const bool is = comparison.relation == Relation::kIs && !comparison.word.empty();
    if (is && found->source != Signal::Source::kEventField) {
      return Error{comparison.subject + " is a number, got '" + comparison.word + "'"};
    }
    Leaf leaf{.compare = CompareOf(comparison.relation),
              .value = comparison.number,
              .tolerance = comparison.tolerance,
              .scale = *scale,
              .fails_unsaid = found->origin() == Origin::kEvents};
    if (is) leaf.value = NumberOf(comparison.word);
    const bool quantity =
        leaf.compare != judge::Compare::kEqual && leaf.compare != judge::Compare::kTrue;
    const std::string unit = comparison.unit.empty() ? found->unit : comparison.unit;
    leaf.signal = PlaceOf(*std::move(found));
    leaves.push_back({.text = judge::Text(comparison),
                      .unit = quantity ? unit : "",
                      .is_number = leaf.compare == judge::Compare::kEqual && !is,
                      .signal = leaf.signal,
                      .leaf = leaf});
    return Formula{.op = judge::Op::kLeaf, .leaf = leaf};
  }

  std::size_t PlaceOf(Signal signal) {
    const auto known = std::ranges::find_if(*signals_, [&signal](const Signal& other) {
      return other.name == signal.name && other.source == signal.source &&
             other.robot == signal.robot;
    });
    const auto place = static_cast<std::size_t>(known - signals_->begin());
    if (known == signals_->end()) signals_->push_back(std::move(signal));
    return place;
  }

  const Names& names_;
  std::vector<Signal>* signals_;
};

}  // namespace

Result<BoundCondition> BindCondition(std::string_view text, const Names& names,
                                     std::vector<Signal>* signals) {
  const auto condition = judge::ReadCondition(text);
  if (!condition) return condition.error();
  Binder binder(names, signals);
  auto formula = binder.Bind(*condition);
  if (!formula) return formula.error();
  judge::NumberLeaves(&*formula);
  return BoundCondition{.formula = *std::move(formula), .leaves = std::move(binder.leaves)};
}

}  // namespace understudy::signals
