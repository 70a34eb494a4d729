// Combines several lambdas into one visitor for std::visit.
#pragma once

namespace understudy {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace understudy
