// Judges claims over samples, both as JSON from standard input, and prints their margins: what
// tests/conformance/test_judge.py compares with another evaluator's.
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "judge/judge.h"

namespace understudy::judge {
namespace {

using nlohmann::json;

Formula FormulaOf(const json& value) {
  static const std::map<std::string, Op> kOps = {
      {"leaf", Op::kLeaf}, {"not", Op::kNot},       {"all", Op::kAll},
      {"any", Op::kAny},   {"always", Op::kAlways}, {"eventually", Op::kEventually}};
  static const std::map<std::string, Compare> kCompares = {{"<", Compare::kBelow},
                                                           {"<=", Compare::kAtMost},
                                                           {">", Compare::kAbove},
                                                           {">=", Compare::kAtLeast}};
  Formula formula{.op = kOps.at(value.at("op"))};
  if (formula.op == Op::kLeaf) {
    formula.leaf = {.signal = value.at("signal"),
                    .compare = kCompares.at(value.at("compare")),
                    .value = value.at("value")};
    return formula;
  }
  for (const json& part : value.at("parts")) formula.parts.push_back(FormulaOf(part));
  formula.from = value.value("from", Time{0});
  formula.to = value.value("to", Time{0});
  return formula;
}

Claim ClaimOf(const json& value) {
  static const std::map<std::string, Operator> kOperators = {{"always", Operator::kAlways},
                                                             {"never", Operator::kNever},
                                                             {"eventually", Operator::kEventually},
                                                             {"final", Operator::kFinal}};
  Claim claim{.op = kOperators.at(value.at("operator")), .formula = FormulaOf(value.at("formula"))};
  if (value.contains("until")) claim.until = FormulaOf(value.at("until"));
  claim.from.at = value.at("from").get<Time>();
  claim.to.at = value.at("to").get<Time>();
  return claim;
}

int Main() {
  json answers = json::array();
  for (const json& one : json::parse(std::cin)) {
    std::vector<Claim> claims{ClaimOf(one.at("claim"))};
    Judge judge(std::move(claims));
    for (const json& sample : one.at("samples")) {
      judge.Take(sample.at(0).get<Time>(), sample.at(1).get<std::vector<double>>());
    }
    judge.Finish();
    const Verdict& verdict = judge.verdict(0);
    answers.push_back({{"outcome", Name(verdict.outcome)}, {"margin", verdict.worth.margin}});
  }
  std::puts(answers.dump().c_str());
  return 0;
}

}  // namespace
}  // namespace understudy::judge

int main() { return understudy::judge::Main(); }
