// What it costs to see by a camera.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// Pictures a second of a standing Go2's camera that a program gets, of 1280 by 720 and of 1920 by
// 1080, and how much of real time the robot keeps meanwhile; the same scene drawn and read back by
// MuJoCo alone. `seconds` of each. Throws std::runtime_error without OpenGL.
std::vector<Figure> MeasurePictures(const std::string& understudy, double seconds);

}  // namespace understudy::bench
