#include "viewer/jpeg.h"

#include <turbojpeg.h>

#include "base/errors.h"

namespace understudy::viewer {

std::string EncodeJpeg(const Image& image, int quality) {
  const tjhandle encoder = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool made =
      encoder != nullptr && tjCompress2(encoder, image.rgb.data(), image.width, 0, image.height,
                                        TJPF_RGB, &bytes, &size, TJSAMP_420, quality, 0) == 0;
  std::string jpeg(reinterpret_cast<const char*>(bytes), made ? size : 0);
  const std::string why = made ? "" : tjGetErrorStr2(encoder);
  tjFree(bytes);
  if (encoder != nullptr) tjDestroy(encoder);
  if (!made) throw SetupError("no JPEG: " + why);
  return jpeg;
}

}  // namespace understudy::viewer
