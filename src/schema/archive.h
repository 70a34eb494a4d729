// The interface between a struct and what processes its keys. A `Describe` function lists each key
// of a struct once; reading, printing and documenting are archives that visit the same rows.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "schema/field.h"

namespace understudy::schema {

// What the documentation says about a key.
struct About {
  // NOLINTNEXTLINE(google-explicit-constructor): most keys have only a meaning
  About(std::string_view does_in) : does(does_in) {}
  About(std::string_view unit_in, Range range_in, std::string_view does_in)
      : unit(unit_in), range(range_in), does(does_in) {}

  std::string_view unit;  // "" if there is none
  Range range;            // of a number, or of each number of a list
  std::string_view does;
};

// A value and its key.
template <class T>
struct Named {
  std::string_view name;
  T* value;
};
template <class T>
Named(std::string_view, T*) -> Named<T>;

// Names a key after its member, as in UNDERSTUDY_NVP(spec.mass), so that the two cannot differ.
#define UNDERSTUDY_NVP(member) \
  ::understudy::schema::Named { ::understudy::schema::AfterDot(#member), &(member) }

constexpr std::string_view AfterDot(std::string_view expression) {
  return expression.substr(expression.rfind('.') + 1);
}

// Where a value is stored. A span is a list of fixed length, a vector a list of any length. An int
// is a whole number, or the index of a word, -1 for none. A number that may be left out is null in
// YAML.
using Slot =
    std::variant<bool*, int*, double*, std::optional<double>*, std::string*, std::span<double>,
                 std::vector<double>*, std::vector<int>*, std::vector<std::string>*>;

// A list of structs, with its element type erased.
struct ListSlot {
  std::function<std::size_t()> size;
  std::function<void(std::size_t)> reset;     // to n default elements
  std::function<void(std::size_t)> describe;  // the element at index i
  std::function<void()> describe_blank;       // a default element
  // The name that selects element i in place of its index; "" if elements have no names.
  std::function<std::string(std::size_t)> name;
};

class Archive {
 public:
  virtual ~Archive() = default;

  // Visits a value of a type in Slot, or an Eigen vector or std::array of doubles.
  template <class T>
  void Key(Named<T> key, const About& about) {
    if constexpr (std::is_constructible_v<Slot, T*>) {
      VisitKey(key.name, about, key.value);
    } else {
      const auto size = static_cast<std::size_t>(key.value->size());
      VisitKey(key.name, about, std::span<double>(key.value->data(), size));
    }
  }

  // Visits an enum whose values count from 0 in the order of `words`.
  template <class E>
  void Choice(Named<E> key, const About& about, std::initializer_list<std::string_view> words) {
    int index = static_cast<int>(*key.value);
    VisitKey(key.name, about, &index, {words.begin(), words.size()});
    *key.value = static_cast<E>(index);
  }

  // Visits a text that must be one of `words`.
  void Word(Named<std::string> key, const About& about, const std::vector<std::string>& words);

  // Visits a nested mapping: calls `describe` between Enter and Leave if Enter returns true. A
  // scalar in place of the mapping is the value of `scalar_key`; "" allows none.
  template <class T>
  void Section(Named<T> key, const About& about, void (*describe)(Archive&, T&),
               std::string_view scalar_key = {}) {
    if (!Enter({.key = key.name, .does = about.does}, scalar_key)) return;
    describe(*this, *key.value);
    Leave();
  }

  // Visits a list of structs. `name` is the member that names an element, null if there is none.
  template <class T>
  void List(Named<std::vector<T>> key, const About& about, void (*describe)(Archive&, T&),
            std::string T::*name = nullptr) {
    std::vector<T>* values = key.value;
    VisitList({.key = key.name, .does = about.does},
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
  virtual void Visit(const Field& field, const Slot& slot) = 0;
  virtual void VisitList(const Field& field, const ListSlot& slot) = 0;
  virtual bool Enter(const Field& field, std::string_view scalar_key) = 0;
  virtual void Leave() = 0;

 private:
  void VisitKey(std::string_view key, const About& about, const Slot& slot,
                std::span<const std::string_view> words = {});
};

// Returns the value as YAML on one line; text is quoted if YAML would not read it back as text.
std::string ValueText(const Field& field, const Slot& slot);

}  // namespace understudy::schema
