// Makes one visitor of several lambdas.
#ifndef UNDERSTUDY_BASE_OVERLOADED_H_
#define UNDERSTUDY_BASE_OVERLOADED_H_

namespace understudy {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace understudy

#endif  // UNDERSTUDY_BASE_OVERLOADED_H_
