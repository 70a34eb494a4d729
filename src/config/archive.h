// The one listing of keys and the visitors that go through it. A `Describe` function names each key
// of a config struct once; reading, printing, the reference and the list of valid keys are all
// archives that walk the same rows.
#ifndef UNDERSTUDY_CONFIG_ARCHIVE_H_
#define UNDERSTUDY_CONFIG_ARCHIVE_H_

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
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

// What is to be said about one key.
struct Row {
  Row(std::string_view name_in, std::string_view meaning_in) : name(name_in), meaning(meaning_in) {}
  Row(std::string_view name_in, std::string_view unit_in, Range range_in,
      std::string_view meaning_in)
      : name(name_in), unit(unit_in), range(range_in), meaning(meaning_in) {}

  std::string_view name;
  std::string_view unit;  // "" where there is none
  Range range;            // of numbers
  std::string_view meaning;
};

// One of some words, by its place among them; -1 for none.
struct WordSlot {
  std::vector<std::string> words;
  int* index;
};

// Numbers; `length` 0 leaves it open how many.
struct NumbersSlot {
  std::vector<double>* values;
  std::size_t length;
};

// Where a value lives.
using Slot = std::variant<bool*, int*, double*, std::string*, WordSlot, NumbersSlot,
                          std::vector<std::string>*>;

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

  void Key(const Row& row, bool* value) { Visit(row, value); }
  void Key(const Row& row, int* value) { Visit(row, value); }
  void Key(const Row& row, double* value) { Visit(row, value); }
  void Key(const Row& row, std::string* value) { Visit(row, value); }
  void Key(const Row& row, std::vector<std::string>* values) { Visit(row, values); }
  void Key(const Row& row, std::vector<double>* values, std::size_t length = 0) {
    Visit(row, NumbersSlot{values, length});
  }

  // An enum whose values count from 0 in the order of `words`.
  template <class E>
  void Choice(const Row& row, std::initializer_list<std::string> words, E* value) {
    int index = static_cast<int>(*value);
    Visit(row, WordSlot{words, &index});
    *value = static_cast<E>(index);
  }

  // Text that must be one of `words`.
  void Word(const Row& row, const std::vector<std::string>& words, std::string* value);

  // A nested mapping: `describe` is called with it entered, or not at all. `scalar_key` is the key
  // that is meant where a bare word stands in place of the mapping.
  template <class F>
  void Section(const Row& row, F describe, std::string_view scalar_key = {}) {
    if (!Enter(row, scalar_key)) return;
    describe();
    Leave();
  }

  // `name` is the member by whose value an element may be meant, null where none tells them apart.
  template <class T>
  void List(const Row& row, std::vector<T>* values, void (*describe)(Archive&, T&),
            std::string T::*name = nullptr) {
    VisitList(row,
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

#endif  // UNDERSTUDY_CONFIG_ARCHIVE_H_
