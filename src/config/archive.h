// The one listing of keys and the visitors that go through it. A `Describe` function names each key
// of a config struct once; reading, printing, the reference and the list of valid keys are all
// archives that walk the same rows.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace understudy::config {

// Both ends belong to it. Values outside and values that are not finite are refused.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

// At least zero.
inline constexpr Range kNotNegative{0, std::numeric_limits<double>::infinity()};

// What the documentation says of a key.
struct About {
  // NOLINTNEXTLINE(google-explicit-constructor): most keys have but a meaning
  About(std::string_view meaning_in) : meaning(meaning_in) {}
  About(std::string_view unit_in, Range range_in, std::string_view meaning_in)
      : unit(unit_in), range(range_in), meaning(meaning_in) {}

  std::string_view unit;  // "" where there is none
  Range range;            // of numbers
  std::string_view meaning;
};

// A key with all that is said of it.
struct Row : About {
  Row(std::string_view name_in, const About& about) : About(about), name(name_in) {}

  std::string_view name;
};

// A value and the key it is read from.
template <class T>
struct Named {
  std::string_view name;
  T* value;
};
template <class T>
Named(std::string_view, T*) -> Named<T>;

// A member under its own name, as UNDERSTUDY_NVP(spec.mass): no key can be bound to another member.
#define UNDERSTUDY_NVP(member) \
  ::understudy::config::Named { ::understudy::config::AfterDot(#member), &(member) }

constexpr std::string_view AfterDot(std::string_view expression) {
  return expression.substr(expression.rfind('.') + 1);
}

// One of some words, by its place among them; -1 for none.
struct WordSlot {
  std::vector<std::string> words;
  int* index;
};

// Where a value lives. A span is a list of just so many numbers, a vector one of any length.
using Slot = std::variant<bool*, int*, double*, std::string*, WordSlot, std::span<double>,
                          std::vector<double>*, std::vector<int>*, std::vector<std::string>*>;

// A list of structs without its type.
struct ListSlot {
  std::function<std::size_t()> size;
  std::function<void(std::size_t)> reset;     // to that many defaults
  std::function<void(std::size_t)> describe;  // the element at an index
  std::function<void()> describe_blank;       // an element of defaults
  // The word by which an element may be meant instead of by its index; "" where elements have none.
  std::function<std::string(std::size_t)> name;
};

class Archive {
 public:
  virtual ~Archive() = default;

  // A value that a Slot can point to, or an Eigen vector or std::array of doubles.
  template <class T>
  void Key(Named<T> key, const About& about) {
    const Row row(key.name, about);
    if constexpr (std::is_constructible_v<Slot, T*>) {
      Visit(row, key.value);
    } else {
      Visit(row, std::span<double>(key.value->data(), static_cast<std::size_t>(key.value->size())));
    }
  }

  // An enum whose values count from 0 in the order of `words`.
  template <class E>
  void Choice(Named<E> key, const About& about, std::initializer_list<std::string> words) {
    int index = static_cast<int>(*key.value);
    Visit(Row(key.name, about), WordSlot{words, &index});
    *key.value = static_cast<E>(index);
  }

  // Text that must be one of `words`.
  void Word(Named<std::string> key, const About& about, const std::vector<std::string>& words);

  // A nested mapping: `describe` is called with it entered, or not at all. `scalar_key` is the key
  // that is meant where a bare word stands in place of the mapping.
  template <class T>
  void Section(Named<T> key, const About& about, void (*describe)(Archive&, T&),
               std::string_view scalar_key = {}) {
    if (!Enter(Row(key.name, about), scalar_key)) return;
    describe(*this, *key.value);
    Leave();
  }

  // `name` is the member by whose value an element may be meant, null where none tells them apart.
  template <class T>
  void List(Named<std::vector<T>> key, const About& about, void (*describe)(Archive&, T&),
            std::string T::*name = nullptr) {
    std::vector<T>* values = key.value;
    VisitList(Row(key.name, about),
              ListSlot{[values] { return values->size(); },
                       [values](std::size_t n) {
                         values->clear();
                         values->resize(n);
                       },
                       [this, values, describe](std::size_t i) { describe(*this, (*values)[i]); },
                       [this, describe] {
                         T blank;
                         describe(*this, blank);
                       },
                       [values, name](std::size_t i) {
                         return name == nullptr ? std::string() : (*values)[i].*name;
                       }});
  }

 protected:
  virtual void Visit(const Row& row, const Slot& slot) = 0;
  virtual void VisitList(const Row& row, const ListSlot& slot) = 0;
  virtual bool Enter(const Row& row, std::string_view scalar_key) = 0;
  virtual void Leave() = 0;
};

// The shortest text that reads back as the same number.
std::string NumberText(double value);

// The value as YAML on one line; text is quoted where YAML would take it for something else.
std::string ValueText(const Slot& slot);

// What a value must be, for errors: "a number from 0 to 10 s", "one of strict, lenient".
std::string Expected(const Row& row, const Slot& slot);

// What a value may be, for tables: "0 to 10", "strict, lenient", "text".
std::string Allowed(const Row& row, const Slot& slot);

}  // namespace understudy::config
