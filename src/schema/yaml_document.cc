#include "schema/yaml_document.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <map>
#include <span>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "base/errors.h"
#include "base/unique_fd.h"

namespace understudy::schema {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20;
constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxValues = 20000;

// As read(2), but waits for what is still to be written into a pipe.
ssize_t ReadSome(int file, std::span<char> to) {
  while (true) {
    const ssize_t count = ::read(file, to.data(), to.size());
    if (count >= 0 || (errno != EAGAIN && errno != EINTR)) return count;
    pollfd wanted{.fd = file, .events = POLLIN, .revents = 0};
    ::poll(&wanted, 1, -1);
  }
}

std::size_t Count(const YamlValue& value) {
  std::size_t n = 1;
  for (const YamlValue& item : value.items) n += Count(item);
  return n;
}

// Builds the tree from the parser's events. An alias becomes a copy of its value. Values are
// counted, so that nested aliases cannot grow without bound.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string name, bool numbered) : name_(std::move(name)), numbered_(numbered) {}

  YamlValue Take() { return std::move(root_); }

  std::string Where(const YAML::Mark& mark) const {
    return numbered_ ? name_ + ":" + std::to_string(mark.line + 1) : name_;
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Add(Make(YamlValue::Kind::kNull, mark), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) Fail(mark, "an alias stands inside the value it names");
    count_ += Count(found->second);
    CheckCount(mark);
    YamlValue copy = found->second;
    Add(std::move(copy), 0);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    RefuseTag(mark, tag);
    YamlValue value = Make(YamlValue::Kind::kScalar, mark);
    value.text = text;
    value.quoted = tag == "!";
    Add(std::move(value), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Open(YamlValue::Kind::kSequence, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Open(YamlValue::Kind::kMap, mark, tag, anchor);
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapEnd() override {
    ResolveMerge(&open_.back().value);
    Close();
  }

 private:
  struct Unfinished {
    YamlValue value;
    YAML::anchor_t anchor;
  };

  [[noreturn]] void Fail(const YAML::Mark& mark, const std::string& what) const {
    throw ConfigError(Where(mark) + ": " + what);
  }

  void CheckCount(const YAML::Mark& mark) const {
    if (count_ > kMaxValues) {
      Fail(mark, "more than " + std::to_string(kMaxValues) + " values, aliases resolved");
    }
  }

  YamlValue Make(YamlValue::Kind kind, const YAML::Mark& mark) {
    ++count_;
    CheckCount(mark);
    YamlValue value;
    value.kind = kind;
    value.where = Where(mark);
    return value;
  }

  void RefuseTag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!")
      Fail(mark, "tag '" + OneLine(tag) + "' is not understood");
  }

  void Open(YamlValue::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    RefuseTag(mark, tag);
    if (open_.size() >= kMaxDepth) {
      Fail(mark, "nested more than " + std::to_string(kMaxDepth) + " levels deep");
    }
    open_.push_back({Make(kind, mark), anchor});
  }

  void Close() {
    Unfinished done = std::move(open_.back());
    open_.pop_back();
    Add(std::move(done.value), done.anchor);
  }

  void Add(YamlValue value, YAML::anchor_t anchor) {
    if (anchor != 0) anchors_[anchor] = value;
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    YamlValue& parent = open_.back().value;
    if (parent.kind == YamlValue::Kind::kMap && parent.keys.size() == parent.items.size()) {
      AddKey(&parent, std::move(value));
      return;
    }
    // The parser reports a missing value at the token after it.
    if (value.kind == YamlValue::Kind::kNull && parent.kind == YamlValue::Kind::kMap) {
      value.where = parent.keys.back().where;
    }
    parent.items.push_back(std::move(value));
  }

  void AddKey(YamlValue* map, YamlValue key) const {
    if (key.kind != YamlValue::Kind::kScalar) {
      throw ConfigError(key.where + ": expected a word as key, got " + Shown(key));
    }
    for (const YamlValue& other : map->keys) {
      if (other.text != key.text) continue;
      throw ConfigError(key.where + ": key '" + OneLine(key.text) + "' is given twice, first at " +
                        other.where);
    }
    map->keys.push_back(std::move(key));
  }

  // `<<: *other` adds the keys of the other map that this one does not have.
  void ResolveMerge(YamlValue* map) {
    const auto merge = std::find_if(map->keys.begin(), map->keys.end(), [](const YamlValue& key) {
      return key.text == "<<" && !key.quoted;
    });
    if (merge == map->keys.end()) return;
    const auto at = merge - map->keys.begin();
    const YamlValue other = std::move(map->items[static_cast<std::size_t>(at)]);
    if (other.kind != YamlValue::Kind::kMap) {
      throw ConfigError(other.where + ": '<<' expects one mapping, got " + Shown(other));
    }
    map->keys.erase(merge);
    map->items.erase(map->items.begin() + at);
    for (std::size_t i = 0; i < other.keys.size(); ++i) {
      if (map->Find(other.keys[i].text) != nullptr) continue;
      map->keys.push_back(other.keys[i]);
      map->items.push_back(other.items[i]);
    }
  }

  std::string name_;
  bool numbered_;
  std::size_t count_ = 0;
  YamlValue root_;
  std::vector<Unfinished> open_;
  std::map<YAML::anchor_t, YamlValue> anchors_;
};

// Refuses a line that begins with %: the parser would silently ignore everything after it.
void RefuseDirectives(const std::string& text, const TreeBuilder& builder) {
  YAML::Mark mark;
  mark.line = 0;
  for (std::size_t at = 0; at < text.size(); ++mark.line) {
    if (text[at] == '%') {
      throw ConfigError(builder.Where(mark) + ": a line that begins with '%' is not understood");
    }
    const std::size_t end = text.find('\n', at);
    at = end == std::string::npos ? text.size() : end + 1;
  }
}

}  // namespace

const YamlValue* YamlValue::Find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].text == key) return &items[i];
  }
  return nullptr;
}

std::optional<YamlValue> TakeOut(YamlValue* map, std::string_view key) {
  for (std::size_t i = 0; i < map->keys.size(); ++i) {
    if (map->keys[i].text != key) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    YamlValue value = std::move(map->items[i]);
    map->keys.erase(map->keys.begin() + at);
    map->items.erase(map->items.begin() + at);
    return value;
  }
  return std::nullopt;
}

YamlValue MapOf(const std::string& key, YamlValue value) {
  YamlValue map;
  map.kind = YamlValue::Kind::kMap;
  map.where = value.where;
  YamlValue& name = map.keys.emplace_back();
  name.kind = YamlValue::Kind::kScalar;
  name.text = key;
  name.where = value.where;
  map.items.push_back(std::move(value));
  return map;
}

std::string OneLine(const std::string& text) {
  constexpr std::size_t kLongest = 64;
  std::string line = text.substr(0, kLongest);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '.');
  return text.size() > kLongest ? line + "..." : line;
}

std::string Shown(const YamlValue& value) {
  switch (value.kind) {
    case YamlValue::Kind::kNull:
      return "nothing";
    case YamlValue::Kind::kSequence:
      return "a list";
    case YamlValue::Kind::kMap:
      return "a mapping";
    case YamlValue::Kind::kScalar:
      break;
  }
  return (value.quoted ? "the quoted text '" : "'") + OneLine(value.text) + "'";
}

YamlValue ParseYaml(const std::string& text, const std::string& name, bool numbered) {
  TreeBuilder builder(name, numbered);
  RefuseDirectives(text, builder);
  try {
    // The parser notices an unclosed quote only if the text does not end in a new line.
    std::istringstream stream(text.substr(0, text.find_last_not_of(" \t\r\n") + 1));
    YAML::Parser parser(stream);
    const bool any = parser.HandleNextDocument(builder);
    YamlValue root = builder.Take();
    if (!any) {
      root.where = name;
      return root;
    }
    TreeBuilder second(name, numbered);
    if (parser.HandleNextDocument(second)) {
      throw ConfigError(second.Take().where + ": a second document begins; one file holds one");
    }
    return root;
  } catch (const YAML::Exception& e) {
    throw ConfigError(builder.Where(e.mark) + ": not valid YAML: " + e.msg);
  }
}

YamlValue ReadYamlFile(const std::filesystem::path& path) {
  const std::string name = path.string();
  // A pipe that somebody writes is read, as a shell's <(command). O_NONBLOCK: opening one that
  // nobody writes must not wait.
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat about {};
  if (!file.valid() || ::fstat(file.get(), &about) != 0) {
    throw ConfigError(name + ": cannot be read: " + std::strerror(errno));
  }
  if (S_ISDIR(about.st_mode)) throw ConfigError(name + ": is a directory");
  std::string text;
  std::array<char, 1U << 14U> piece;
  ssize_t count = 0;
  while ((count = ReadSome(file.get(), piece)) > 0 && text.size() <= kMaxBytes) {
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
  if (count < 0) throw ConfigError(name + ": reading failed: " + std::strerror(errno));
  if (text.empty() && S_ISFIFO(about.st_mode)) {
    throw ConfigError(name + ": is a pipe into which nobody writes");
  }
  if (text.size() > kMaxBytes) throw ConfigError(name + ": larger than 1 MiB, no configuration");
  return ParseYaml(text, name);
}

std::vector<std::string> YamlNames(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace understudy::schema
