#include "terrain/file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "terrain/image.h"

namespace understudy::terrain {
namespace {

constexpr double kHeightsBase = 0.5;  // m of solid ground below the lowest point; assumed

// Sky, floor and light as in models/scene/flat.xml. The sun stands lower, and height fields have
// one colour, so that slopes of a few degrees differ visibly.
constexpr char kHead[] = R"(  <visual>
    <headlight ambient="0.3 0.31 0.33" diffuse="0.14 0.14 0.14" specular="0.05 0.05 0.05"/>
    <rgba haze="0.86 0.88 0.9 1"/>
  </visual>
  <asset>
    <texture name="sky" type="skybox" builtin="gradient" rgb1="0.66 0.75 0.85" rgb2="0.95 0.96 0.97"
      width="256" height="1536"/>
    <texture name="ground" type="2d" builtin="checker" rgb1="0.65 0.66 0.66" rgb2="0.7 0.71 0.71"
      mark="random" markrgb="0.6 0.61 0.61" random="0.12" width="512" height="512"/>
    <material name="floor" texture="ground" texuniform="true" texrepeat="1 1" specular="0.1"
      shininess="0.1"/>
)";
constexpr char kSun[] =
    R"(    <light name="sun" directional="true" pos="2 -1 4" dir="-0.75 0.38 -0.55" diffuse="0.72 0.71 0.69"
      specular="0.2 0.2 0.2"/>
    <light name="fill" directional="true" castshadow="false" pos="-2 2 3" dir="0.6 -0.5 -0.4"
      diffuse="0.12 0.13 0.15" specular="0 0 0"/>
)";
// Between walls the sun stands high, and the sky gives more of the light.
constexpr char kPlaceSun[] =
    R"(    <light name="sun" directional="true" pos="2 -1 4" dir="-0.25 0.3 -0.9" diffuse="0.5 0.49 0.46"
      specular="0.15 0.15 0.15"/>
    <light name="fill" directional="true" castshadow="false" pos="-2 2 3" dir="0.6 -0.5 -0.4"
      diffuse="0.16 0.17 0.19" specular="0 0 0" ambient="0.16 0.16 0.16"/>
)";
// Neighbouring pieces differ in colour, so that edges are visible.
constexpr std::array<const char*, 3> kColours = {"0.66 0.62 0.55 1", "0.6 0.57 0.52 1",
                                                 "0.71 0.67 0.6 1"};

// Prints nine digits and rounds to nanometres, so that rounding errors of sums do not appear.
std::string Number(double value) {
  constexpr double kSmallest = 1e-9;
  value = std::round(value / kSmallest) * kSmallest;
  if (value == 0) value = 0;  // not -0
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9);
  return {text.data(), end};
}

std::string Numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + Number(value);
  return text;
}

// MuJoCo uses the friction of the geom with the higher priority, at equal priority the larger one.
std::string Contact(double friction) {
  if (friction == 0) return " condim=\"3\" friction=\"0.8 0.005 0.0001\"";
  return " condim=\"3\" friction=\"" + Number(friction) + " 0.005 0.0001\" priority=\"1\"";
}

std::string HeightsName(std::size_t i) { return "terrain_" + std::to_string(i); }

float Lowest(const HeightGrid& grid) { return *std::min_element(grid.z.begin(), grid.z.end()); }
float Highest(const HeightGrid& grid) { return *std::max_element(grid.z.begin(), grid.z.end()); }

// Metres per grey level of the PNG: the step of the lattice if 16 bits suffice.
double GreyStep(const HeightGrid& grid) {
  return std::max(kHeightStep, (Highest(grid) - Lowest(grid)) / 65535.0);
}

std::string HeightsAsset(const TerrainPiece& piece, const HeightGrid& grid) {
  const std::string name = HeightsName(piece.heights);
  return "    <!-- " + name + ".png: the same heights as grey levels of " +
         Number(GreyStep(grid) * 1000) +
         " mm, black at z = " + Number(OnHeightLattice(Lowest(grid))) +
         " m -->\n    <hfield name=\"" + name + "\" file=\"" + name + ".hf\" size=\"" +
         Numbers({piece.half_x, piece.half_y, *piece.thickness, kHeightsBase}) + "\"/>\n";
}

std::string Geom(const TerrainPiece& piece, std::size_t i, double floor) {
  const double thickness = piece.thickness.value_or(piece.top - floor);
  std::string text = "    <geom name=\"ground_" + std::to_string(i) + "\" type=\"";
  if (piece.shape == PieceShape::kHeights) {
    const std::string at = Numbers({piece.x, piece.y, piece.top - thickness});
    return text + "hfield\" hfield=\"" + HeightsName(piece.heights) + "\" pos=\"" + at +
           "\" rgba=\"0.72 0.66 0.55 1\"" + Contact(piece.friction) + "/>\n";
  }
  // The centre of a pitched plank is half its thickness below its top, along the top's normal.
  const double half = thickness / 2, back = half * std::sin(piece.pitch);
  const std::string at =
      Numbers({piece.x - back * std::cos(piece.yaw), piece.y - back * std::sin(piece.yaw),
               piece.top - half * std::cos(piece.pitch)});
  text += piece.shape == PieceShape::kSheet
              ? "plane\" size=\"" + Numbers({piece.half_x, piece.half_y, 1})
          : piece.shape == PieceShape::kCylinder
              ? "cylinder\" size=\"" + Numbers({piece.half_x, half})
              : "box\" size=\"" + Numbers({piece.half_x, piece.half_y, half});
  text += "\" pos=\"" + at + "\"";
  if (piece.pitch != 0 || piece.yaw != 0) {
    const double cp = std::cos(piece.pitch / 2), sp = std::sin(piece.pitch / 2);
    const double cy = std::cos(piece.yaw / 2), sy = std::sin(piece.yaw / 2);
    text += " quat=\"" + Numbers({cy * cp, -sy * sp, cy * sp, sy * cp}) + "\"";
  }
  text += std::string(" rgba=\"") +
          (piece.colour == nullptr ? kColours[i % kColours.size()] : piece.colour) + "\"";
  return text + (piece.solid ? Contact(piece.friction) : " contype=\"0\" conaffinity=\"0\"") +
         "/>\n";
}

// Ground lies across the way, so that it is cut along x only; things stand anywhere.
std::pair<int, int> CellOf(const TerrainPiece& piece) {
  const auto cell = [](double at) { return static_cast<int>(std::floor(at)); };  // of 1 m
  return {cell(piece.x), piece.colour == nullptr ? 0 : cell(piece.y)};
}

std::string FloorColour(const char* colour) {
  return colour == nullptr ? "" : std::string(" rgba=\"") + colour + "\"";
}

std::string SceneXml(const TerrainPieces& terrain, const std::string& name, double friction,
                     const std::string& assets, const std::string& bodies) {
  std::string text = "<mujoco model=\"" + name + "\">\n" + kHead + assets;
  text += "  </asset>\n  <worldbody>\n";
  text += terrain.floor_colour() == nullptr ? kSun : kPlaceSun;
  text += "    <geom name=\"floor\" type=\"plane\" size=\"0 0 0.5\" pos=\"" +
          Numbers({0, 0, terrain.floor()}) + "\" material=\"floor\"" +
          FloorColour(terrain.floor_colour()) + Contact(friction) + "/>\n";
  return text + bodies + "  </worldbody>\n</mujoco>\n";
}

std::string Assets(const TerrainPieces& terrain) {
  std::string text;
  for (const TerrainPiece& piece : terrain.Pieces()) {
    if (piece.shape == PieceShape::kHeights) {
      text += HeightsAsset(piece, terrain.heights()[piece.heights]);
    }
  }
  return text;
}

std::string Bodies(const TerrainPieces& terrain) {
  std::string text;
  const std::vector<TerrainPiece> pieces = terrain.Pieces();
  // Groups the pieces into static bodies: MuJoCo 2 tests all pairs of geoms of two nearby bodies,
  // and the world body is near everything. A body with a height field would be so too: MuJoCo has
  // room for the pairs of each two bodies once, which the pairs of such bodies do not all fit in.
  std::map<std::pair<int, int>, std::string> bodies;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool of_world = !pieces[i].solid || pieces[i].shape == PieceShape::kHeights;
    (of_world ? text : bodies[CellOf(pieces[i])]) += Geom(pieces[i], i, terrain.floor());
  }
  for (const auto& [cell, geoms] : bodies) text += "    <body>\n" + geoms + "    </body>\n";
  return text;
}

// Rows and columns as 32-bit integers, then the heights as 32-bit floats, in the machine's byte
// order.
void WriteBinary(const std::filesystem::path& file, const HeightGrid& grid) {
  static_assert(std::endian::native == std::endian::little);
  const std::array<std::int32_t, 2> sides{grid.rows, grid.columns};
  std::string bytes(reinterpret_cast<const char*>(sides.data()), sizeof sides);
  bytes.append(reinterpret_cast<const char*>(grid.z.data()), sizeof(float) * grid.z.size());
  WriteBytes(file, bytes);
}

// The top of the picture is +y.
void WritePng(const std::filesystem::path& file, const HeightGrid& grid) {
  const double step = GreyStep(grid), low = Lowest(grid);
  const auto columns = static_cast<std::size_t>(grid.columns);
  std::vector<std::uint16_t> grey;
  for (std::size_t row = static_cast<std::size_t>(grid.rows); row-- > 0;) {
    for (std::size_t column = 0; column < columns; ++column) {
      grey.push_back(
          static_cast<std::uint16_t>(std::lround((grid.z[row * columns + column] - low) / step)));
    }
  }
  WriteGreyPng(file, grid.columns, grid.rows, grey);
}

}  // namespace

void WriteBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw ModelError(file.string() + ": cannot be written");
}

void WriteTerrainFiles(const TerrainPieces& pieces, const std::string& name, double floor_friction,
                       const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw ModelError(folder.string() + ": cannot be made: " + error.message());
  WriteBytes(folder / "scene.xml",
             SceneXml(pieces, name, floor_friction, Assets(pieces), Bodies(pieces)));
  for (std::size_t i = 0; i < pieces.heights().size(); ++i) {
    WriteBinary(folder / (HeightsName(i) + ".hf"), pieces.heights()[i]);
    WritePng(folder / (HeightsName(i) + ".png"), pieces.heights()[i]);
  }
}

void WriteSightFile(const TerrainPieces& pieces, const std::string& name, const std::string& assets,
                    const std::string& geoms, const std::filesystem::path& folder) {
  WriteBytes(folder / "sight.xml", SceneXml(pieces, name, 0, assets, geoms));
}

}  // namespace understudy::terrain
