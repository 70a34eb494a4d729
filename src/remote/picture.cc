#include "remote/picture.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/printed.h"
#include "remote/keyboard.h"

namespace understudy::remote {
namespace {

constexpr char kHome[] = "\033[H";
constexpr char kToEndOfLine[] = "\033[K";
constexpr char kToEndOfScreen[] = "\033[J";
constexpr char kInverse[] = "\033[7m";
constexpr char kPlain[] = "\033[0m";

struct Place {
  int row, column;
};

struct KeyPlace {
  std::uint16_t key;
  Place at;
};

constexpr KeyPlace kKeyPlaces[] = {
    {robot::RemoteBit("L2"), {2, 2}},      {robot::RemoteBit("R2"), {2, 50}},
    {robot::RemoteBit("L1"), {3, 2}},      {robot::RemoteBit("R1"), {3, 50}},
    {robot::RemoteBit("SELECT"), {5, 15}}, {robot::RemoteBit("START"), {5, 31}},
    {robot::RemoteBit("F1"), {6, 15}},     {robot::RemoteBit("F2"), {6, 31}},
    {robot::RemoteBit("UP"), {8, 7}},      {robot::RemoteBit("LEFT"), {9, 1}},
    {robot::RemoteBit("RIGHT"), {9, 12}},  {robot::RemoteBit("DOWN"), {10, 6}},
    {robot::RemoteBit("Y"), {8, 48}},      {robot::RemoteBit("X"), {9, 43}},
    {robot::RemoteBit("B"), {9, 53}},      {robot::RemoteBit("A"), {10, 48}},
};
constexpr Place kLeftStick{12, 8};
constexpr Place kRightStick{12, 38};
constexpr int kStickHeight = 5;
constexpr int kStickWidth = 11;
constexpr int kHeight = 19;
constexpr std::size_t kWidth = 62;

// Characters, and which of them are inverse.
struct Canvas {
  std::vector<std::string> lines = std::vector<std::string>(kHeight, std::string(kWidth, ' '));
  std::vector<std::string> inverse = lines;

  void Write(Place at, std::string_view text, bool lit = false) {
    const auto row = static_cast<std::size_t>(at.row);
    const auto column = static_cast<std::size_t>(at.column);
    const std::size_t size = std::min(text.size(), kWidth - column);
    lines[row].replace(column, size, text.substr(0, size));
    inverse[row].replace(column, size, std::string(size, lit ? '#' : ' '));
  }
};

std::string Harmless(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char byte) { return byte < ' ' || byte > '~'; }, '?');
  return text;
}

void DrawKeys(std::uint16_t pressed, Canvas* canvas) {
  for (const KeyPlace& place : kKeyPlaces) {
    const auto* const binding =
        std::find_if(kKeyBindings.begin(), kKeyBindings.end(),
                     [&](const KeyBinding& row) { return row.remote_key == place.key; });
    std::string label = " " + robot::RemoteKeyNames(place.key);
    const std::string_view shown = binding->shown;
    // An arrow needs no word for its key.
    if (binding->key < kUpKey) label.append(":").append(shown);
    canvas->Write(place.at, label + " ", (pressed & place.key) != 0);
  }
}

void DrawStick(Place at, const char* name, const char* keys, double x, double y, Canvas* canvas) {
  const std::string edge = "+" + std::string(kStickWidth, '-') + "+";
  canvas->Write(at, edge);
  canvas->Write({at.row + kStickHeight + 1, at.column}, edge);
  for (int row = 1; row <= kStickHeight; ++row) {
    canvas->Write({at.row + row, at.column}, "|" + std::string(kStickWidth, ' ') + "|");
  }
  const int across = static_cast<int>(std::lround((x + 1) / 2 * (kStickWidth - 1)));
  const int down = static_cast<int>(std::lround((1 - y) / 2 * (kStickHeight - 1)));
  canvas->Write({at.row + 1 + down, at.column + 1 + across}, "o", x != 0 || y != 0);
  const int beside = at.column + kStickWidth + 3;
  canvas->Write({at.row + 1, beside}, keys);
  canvas->Write({at.row + 3, beside}, Printed("%sx %+.2f", name, x));
  canvas->Write({at.row + 4, beside}, Printed("%sy %+.2f", name, y));
}

// The first `columns` of a line, with its colours.
std::string Line(const std::string& text, const std::string& inverse, std::size_t columns) {
  std::string line;
  bool lit = false;
  for (std::size_t i = 0; i < std::min(text.size(), columns); ++i) {
    const bool now = i < inverse.size() && inverse[i] == '#';
    if (now != lit) line += now ? kInverse : kPlain;
    lit = now;
    line += text[i];
  }
  return lit ? line + kPlain : line;
}

}  // namespace

std::string Draw(const RemotePicture& picture, int columns, int rows) {
  Canvas canvas;
  canvas.Write({0, 1}, Harmless(picture.title));
  DrawKeys(picture.reading.keys, &canvas);
  DrawStick(kLeftStick, "l", "e d s f", picture.reading.lx, picture.reading.ly, &canvas);
  DrawStick(kRightStick, "r", "i k j l", picture.reading.rx, picture.reading.ry, &canvas);
  for (const std::string& note : picture.notes) {
    canvas.lines.push_back(" " + Harmless(note));
    canvas.inverse.emplace_back();
  }

  const auto width = static_cast<std::size_t>(std::max(columns, 0));
  const auto height = static_cast<std::size_t>(std::max(rows, 0));
  std::string screen = kHome;
  for (std::size_t row = 0; row < std::min(canvas.lines.size(), height); ++row) {
    if (row > 0) screen += "\r\n";
    screen += Line(canvas.lines[row], canvas.inverse[row], width) + kToEndOfLine;
  }
  return screen + kToEndOfScreen;
}

}  // namespace understudy::remote
