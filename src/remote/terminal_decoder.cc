#include "remote/terminal_decoder.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>

namespace understudy::remote {
namespace {

using Keys = std::vector<TerminalKey>;

constexpr char kEscape = '\x1b';
constexpr std::size_t kLongest = 64;  // bytes of a sequence; no known one is as long

std::optional<char32_t> Arrow(char final) {
  if (final < 'A' || final > 'D') return std::nullopt;
  constexpr char32_t kArrows[] = {kUpKey, kDownKey, kRightKey, kLeftKey};
  return kArrows[final - 'A'];
}

// ESC [ parameters final. An arrow with a modifier is "1;2A"; the modifier is 1 + 1 for shift, + 4
// for control.
void Decode(std::string_view parameters, char final, Keys* keys) {
  const std::optional<char32_t> arrow = Arrow(final);
  if (!arrow) return;
  unsigned modifiers = 1;
  if (parameters.starts_with("1;")) {
    std::from_chars(parameters.data() + 2, parameters.data() + parameters.size(), modifiers);
  }
  keys->push_back({.key = *arrow,
                   .shift = ((modifiers - 1) & 1U) != 0,
                   .control = ((modifiers - 1) & 4U) != 0});
}

// One byte that begins no sequence.
void DecodeByte(char byte, Keys* keys) {
  if (byte == '\n') byte = '\r';
  if (byte >= 'A' && byte <= 'Z') {
    keys->push_back({.key = static_cast<char32_t>(byte - 'A' + 'a'), .shift = true});
  } else if (byte == '\r' || byte == '\t' || (byte >= ' ' && byte <= '~')) {
    keys->push_back({.key = static_cast<char32_t>(byte)});
  } else if (byte >= 1 && byte <= 26) {
    keys->push_back({.key = static_cast<char32_t>(byte - 1 + 'a'), .control = true});
  }
}

bool IsFinal(char byte) { return byte >= '@' && byte <= '~'; }

// How many bytes of `text` the sequence at its front has; 0: not all of it is there yet. kLongest
// bytes may be the beginning of one that is longer than all that is known.
std::size_t DecodeFront(std::string_view text, Keys* keys) {
  if (text[0] != kEscape) {
    DecodeByte(text[0], keys);
    return 1;
  }
  if (text.size() < 2) return 0;
  if (text[1] == 'O') {  // an arrow in application mode
    if (text.size() < 3) return 0;
    if (const auto arrow = Arrow(text[2])) keys->push_back({.key = *arrow});
    return 3;
  }
  if (text[1] != '[') {  // with Alt
    keys->push_back({.key = kEscapeKey});
    return 1;
  }
  const std::string_view front = text.substr(0, kLongest);
  const auto* const final = std::find_if(front.begin() + 2, front.end(), IsFinal);
  if (final == front.end()) return text.size() < kLongest ? 0 : kLongest;
  const auto size = static_cast<std::size_t>(final - front.begin()) + 1;
  if (*final == '[') return text.size() > size ? size + 1 : 0;  // F1 to F5 of the Linux console
  Decode(text.substr(2, size - 3), *final, keys);
  return size;
}

}  // namespace

Keys TerminalDecoder::Feed(std::string_view bytes) {
  Keys keys;
  pending_ += bytes;
  while (!pending_.empty()) {
    if (skips_) {
      skips_ = !IsFinal(pending_.front());
      pending_.erase(0, 1);
      continue;
    }
    const std::size_t size = DecodeFront(pending_, &keys);
    if (size == 0) break;
    skips_ = size == kLongest && !IsFinal(pending_[size - 1]);
    pending_.erase(0, size);
  }
  return keys;
}

Keys TerminalDecoder::Pause() {
  Keys keys;
  if (pending_ == std::string_view(&kEscape, 1)) keys.push_back({.key = kEscapeKey});
  pending_.clear();
  skips_ = false;
  return keys;
}

}  // namespace understudy::remote
