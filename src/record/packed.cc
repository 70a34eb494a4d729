#include "record/packed.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <zstd.h>

#include "base/errors.h"

namespace understudy::record {
namespace {

// Bytes to which a message, and a file of so many bytes, are unpacked at most; *assumed*, many
// times what robots say: a few bytes of a stranger could else fill memory or disk.
constexpr std::uint64_t kMostMessage = 1U << 28U;
std::uint64_t MostUnpacked(std::uint64_t file) { return (std::uint64_t{1} << 28U) + 200 * file; }

void UnpackFile(const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto fail = [&](const std::string& what) {
    throw RecordError(from.string() + ": does not unpack: " + what);
  };
  const std::uint64_t most = MostUnpacked(std::filesystem::file_size(from));
  std::ifstream in(from, std::ios::binary);
  std::ofstream out(to, std::ios::binary);
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(),
                                                                        &ZSTD_freeDCtx);
  std::vector<char> packed(ZSTD_DStreamInSize()), unpacked(ZSTD_DStreamOutSize());
  std::uint64_t size = 0;
  std::size_t expected = 1;  // 0 at the end of a frame
  while (in && out) {
    in.read(packed.data(), static_cast<std::streamsize>(packed.size()));
    ZSTD_inBuffer input{packed.data(), static_cast<std::size_t>(in.gcount()), 0};
    while (input.pos < input.size && out) {
      ZSTD_outBuffer output{unpacked.data(), unpacked.size(), 0};
      expected = ZSTD_decompressStream(context.get(), &output, &input);
      if (ZSTD_isError(expected) != 0) fail(ZSTD_getErrorName(expected));
      size += output.pos;
      if (size > most) fail("it has more than " + std::to_string(most) + " bytes");
      out.write(unpacked.data(), static_cast<std::streamsize>(output.pos));
    }
  }
  out.close();
  if (!out) fail(to.parent_path().string() + " is full; TMPDIR names another folder for it");
  if (expected != 0) fail("it ends early");
}

bool BeginsPacked(ByteSpan data) {
  return data.size() >= kZstdMagic.size() &&
         std::ranges::equal(data.first(kZstdMagic.size()), AsBytes(kZstdMagic));
}

// Where nothing is yet in `folder`: a bag may have files of one name in several folders of its own.
std::filesystem::path FreePlace(const std::filesystem::path& folder,
                                const std::filesystem::path& name) {
  std::filesystem::path place = folder / name;
  for (int i = 2; std::filesystem::exists(place); ++i) {
    place = folder / (std::to_string(i) + "-" + name.string());
  }
  return place;
}

}  // namespace

std::uint64_t MostUnpacked(std::uint64_t file) { return (std::uint64_t{1} << 28U) + 200 * file; }

ByteSpan Unpacked(ByteSpan data, const std::filesystem::path& file, std::vector<std::byte>* room) {
  if (!BeginsPacked(data)) return data;
  const unsigned long long size = ZSTD_getFrameContentSize(data.data(), data.size());
  if (size > kMostMessage) {  // so are the values that stand for an unknown one
    throw RecordError(file.string() + ": a compressed message of unknown size or of more than " +
                      std::to_string(kMostMessage) + " bytes");
  }
  room->resize(static_cast<std::size_t>(size));
  const std::size_t unpacked =
      ZSTD_decompress(room->data(), room->size(), data.data(), data.size());
  if (ZSTD_isError(unpacked) != 0) {
    throw RecordError(file.string() +
                      ": a message does not unpack: " + ZSTD_getErrorName(unpacked));
  }
  return ByteSpan(*room).first(unpacked);
}

bool IsPacked(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::array<char, kZstdMagic.size()> first{};
  std::ifstream file(path, std::ios::binary);
  file.read(first.data(), static_cast<std::streamsize>(first.size()));
  return file && BeginsPacked(AsBytes({first.data(), first.size()}));
}

PackedFile::PackedFile(const std::filesystem::path& path,
                       std::shared_ptr<const TemporaryFolder> room)
    : RecordingReader(path), room_(std::move(room)), file_(FreePlace(room_->path(), path.stem())) {
  UnpackFile(path, file_);
  if (IsPacked(file_)) throw RecordError(path.string() + ": is compressed twice");
  Tell([this] { inside_ = OpenRecording(file_); });
  contents_ = inside_->contents();
}

void PackedFile::ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const {
  Tell([&] { inside_->ReadMessages(from, to, visit); });
  contents_.cut_short = inside_->contents().cut_short;
}

void PackedFile::Tell(const std::function<void()>& read) const {
  try {
    read();
  } catch (const RecordError& error) {
    std::string what = error.what();
    const std::string inside = file_.string();
    if (what.starts_with(inside)) what.replace(0, inside.size(), path().string());
    throw RecordError(what);
  }
}

}  // namespace understudy::record
