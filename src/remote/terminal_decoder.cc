#include "remote/terminal_decoder.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace understudy::remote {
namespace {

using Kind = TerminalEvent::Kind;
using Events = std::vector<TerminalEvent>;

constexpr char kEscape = '\x1b';
constexpr std::size_t kLongest = 64;    // bytes of a sequence; no known one is as long
constexpr unsigned kReportsEvents = 2;  // a flag of the kitty keyboard protocol

// Reads digits from the front of `text`; `otherwise` where there are none.
unsigned TakeNumber(std::string_view* text, unsigned otherwise) {
  constexpr unsigned kMost = 0x200000;  // beyond every code point
  std::optional<unsigned> number;
  while (!text->empty() && text->front() >= '0' && text->front() <= '9') {
    const auto digit = static_cast<unsigned>(text->front() - '0');
    number = std::min(number.value_or(0) * 10 + digit, kMost);
    text->remove_prefix(1);
  }
  return number.value_or(otherwise);
}

void SkipTo(char end, std::string_view* text) {
  text->remove_prefix(std::min(text->size(), text->find(end)));
  if (!text->empty()) text->remove_prefix(1);
}

std::optional<char32_t> Arrow(char final) {
  if (final < 'A' || final > 'D') return std::nullopt;
  constexpr char32_t kArrows[] = {kUpKey, kDownKey, kRightKey, kLeftKey};
  return kArrows[final - 'A'];
}

// CSI parameters final: "code:...; modifiers:event; ..." of the kitty protocol, of which other
// terminals' arrows are a part.
void Decode(std::string_view parameters, char final, Events* events) {
  if (final == 'O' && parameters.empty()) return events->push_back({.kind = Kind::kFocusLost});
  if (parameters.starts_with('?')) {
    parameters.remove_prefix(1);
    const unsigned flags = TakeNumber(&parameters, 0);
    if (final == 'u' && (flags & kReportsEvents) != 0) {
      events->push_back({.kind = Kind::kReportsReleases});
    }
    return;
  }
  const std::optional<char32_t> arrow = Arrow(final);
  if (final != 'u' && !arrow) return;
  const unsigned code = TakeNumber(&parameters, 0);
  SkipTo(';', &parameters);
  const unsigned modifiers = TakeNumber(&parameters, 1) - 1;
  unsigned event = 1;
  if (parameters.starts_with(':')) {
    parameters.remove_prefix(1);
    event = TakeNumber(&parameters, 1);
  }
  const Kind kind = event == 3 ? Kind::kRelease : event == 2 ? Kind::kRepeat : Kind::kPress;
  events->push_back({.kind = kind,
                     .key = arrow.value_or(code),
                     .shift = (modifiers & 1U) != 0,
                     .control = (modifiers & 4U) != 0});
}

// One byte that begins no sequence.
void DecodeByte(char byte, Events* events) {
  if (byte == '\n') byte = '\r';
  if (byte >= 'A' && byte <= 'Z') {
    events->push_back({.key = static_cast<char32_t>(byte - 'A' + 'a'), .shift = true});
  } else if (byte == '\r' || byte == '\t' || (byte >= ' ' && byte <= '~')) {
    events->push_back({.key = static_cast<char32_t>(byte)});
  } else if (byte >= 1 && byte <= 26) {
    events->push_back({.key = static_cast<char32_t>(byte - 1 + 'a'), .control = true});
  }
}

// How many bytes of `text` the sequence at its front has; 0: not all of it is there yet.
std::size_t DecodeFront(std::string_view text, Events* events) {
  if (text[0] != kEscape) {
    DecodeByte(text[0], events);
    return 1;
  }
  if (text.size() < 2) return 0;
  if (text[1] == 'O') {  // an arrow in application mode
    if (text.size() < 3) return 0;
    if (const auto arrow = Arrow(text[2])) events->push_back({.key = *arrow});
    return 3;
  }
  if (text[1] != '[') {  // with Alt
    events->push_back({.key = kEscapeKey});
    return 1;
  }
  const auto* const final = std::find_if(text.begin() + 2, text.end(),
                                         [](char byte) { return byte >= '@' && byte <= '~'; });
  if (final == text.end()) return text.size() < kLongest ? 0 : text.size();
  const auto size = static_cast<std::size_t>(final - text.begin()) + 1;
  if (*final == '[') return text.size() > size ? size + 1 : 0;  // F1 to F5 of the Linux console
  Decode(text.substr(2, size - 3), *final, events);
  return size;
}

}  // namespace

Events TerminalDecoder::Feed(std::string_view bytes) {
  Events events;
  pending_ += bytes;
  while (!pending_.empty()) {
    const std::size_t size = DecodeFront(pending_, &events);
    if (size == 0) break;
    pending_.erase(0, size);
  }
  return events;
}

Events TerminalDecoder::Pause() {
  Events events;
  if (pending_ == std::string_view(&kEscape, 1)) events.push_back({.key = kEscapeKey});
  pending_.clear();
  return events;
}

}  // namespace understudy::remote
