#include "common/recording/decompression.hpp"

#include <dlfcn.h>

#include "common/recording/recording_error.hpp"

namespace longreach {
namespace {

constexpr std::uint64_t kSizeMax = std::uint64_t{256} << 20U;  // chunks of a few MiB are usual

/// A library that is loaded for good.
class Library {
 public:
  Library(const char* file, const char* package) : handle_(::dlopen(file, RTLD_NOW)), package_(package) {}

  template <class Function>
  Function* function(const char* name) const {
    void* found = handle_ == nullptr ? nullptr : ::dlsym(handle_, name);
    if (found == nullptr)
      throw RecordingError(
          std::string("its chunks are compressed; to read them, install the Debian package ") + package_);
    return reinterpret_cast<Function*>(found);
  }

 private:
  void* handle_;
  const char* package_;
};

[[noreturn]] void damaged() { throw RecordingError("a compressed chunk cannot be decompressed"); }

std::string from_zstd(std::string_view bytes, std::size_t size) {
  static const Library library("libzstd.so.1", "libzstd1");
  static const auto unpack =
      library.function<std::size_t(void*, std::size_t, const void*, std::size_t)>("ZSTD_decompress");
  std::string out(size, '\0');
  if (unpack(out.data(), out.size(), bytes.data(), bytes.size()) != size)
    damaged();  // errors are huge numbers
  return out;
}

std::string from_lz4(std::string_view bytes, std::size_t size) {
  constexpr unsigned kVersion = 100;  // LZ4F_VERSION
  static const Library library("liblz4.so.1", "liblz4-1");
  static const auto create =
      library.function<std::size_t(void**, unsigned)>("LZ4F_createDecompressionContext");
  static const auto free = library.function<std::size_t(void*)>("LZ4F_freeDecompressionContext");
  static const auto is_error = library.function<unsigned(std::size_t)>("LZ4F_isError");
  static const auto unpack =
      library.function<std::size_t(void*, void*, std::size_t*, const void*, std::size_t*, const void*)>(
          "LZ4F_decompress");
  void* context = nullptr;
  if (is_error(create(&context, kVersion)) != 0) damaged();
  std::string out(size, '\0');
  std::size_t done = 0, read = 0;
  bool fine = true;
  while (fine && read < bytes.size()) {
    std::size_t room = size - done, left = bytes.size() - read;
    fine = is_error(unpack(context, out.data() + done, &room, bytes.data() + read, &left, nullptr)) == 0 &&
           (room > 0 || left > 0);
    done += room;
    read += left;
  }
  free(context);
  if (!fine || done != size) damaged();
  return out;
}

}  // namespace

std::string decompress(std::string_view how, std::string_view bytes, std::uint64_t size) {
  if (size > kSizeMax) throw RecordingError("a compressed chunk exceeds the maximum of 256 MiB");
  if (how == "zstd") return from_zstd(bytes, static_cast<std::size_t>(size));
  if (how == "lz4") return from_lz4(bytes, static_cast<std::size_t>(size));
  throw RecordingError("its chunks are compressed with \"" + std::string(how) +
                       "\", but only zstd and lz4 are supported; recompress it with one of them");
}

}  // namespace longreach
