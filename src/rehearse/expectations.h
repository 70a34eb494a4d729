// Reads what is expected of a run.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "judge/claim.h"
#include "schema/yaml_document.h"
#include "signals/bound_condition.h"

namespace understudy::rehearse {

using signals::LeafText;
using signals::Names;
using signals::Signal;

struct Expectation {
  std::string name;
  std::string says{};   // a sentence for people
  std::string asks{};   // "always base.tilt < 30 deg, from 1 s"
  std::string where{};  // "stand.yaml:12"
  judge::Claim claim{};
  std::vector<LeafText> leaves{};        // of claim.formula
  std::vector<LeafText> until_leaves{};  // of claim.until
  std::vector<std::size_t> signals{};    // all that it needs, ascending

  // Returns the comparison that a verdict names.
  const LeafText& LeafOf(const judge::Verdict& verdict) const {
    return (verdict.of_until ? until_leaves : leaves)[verdict.worth.leaf];
  }
};

struct Expectations {
  std::vector<Expectation> list{};
  std::vector<Signal> signals{};      // of all, each once
  std::vector<std::string> robots{};  // by number, of several; else empty
  bool safe = false;                  // no figure of the damage sheet is beyond its limit, too
  bool script = false;                // no event of the script is refused, too

  std::vector<judge::Claim> claims() const;
};

// Reads the list under `expect`. Throws ConfigError with file, line, key, what was expected and the
// nearest word. The item `safe` stands for the standard set.
Expectations ReadExpectations(const schema::YamlValue& list, const Names& names);

// Returns the keys of an expectation as Markdown.
std::string ExpectationsReference();

}  // namespace understudy::rehearse
