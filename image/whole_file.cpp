// SPDX-License-Identifier: MIT
#include "image/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/error.h"

namespace spindrift::image
{

namespace
{

[[noreturn]] void fail(const char* verb, const std::filesystem::path& file, const std::string& why)
{
    throw Error(fmt::format("{}: cannot {}: {}", file.string(), verb, why));
}

[[noreturn]] void fail(const char* verb, const std::filesystem::path& file, int error)
{
    fail(verb, file, std::generic_category().message(error));
}

std::filesystem::path resolved(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_symlink(file, error)) return file;
    const auto target = std::filesystem::canonical(file, error);
    return error ? file : target;
}

/// The folder that a file lies in, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Makes the entry of a renamed file last; some file systems cannot, and the file is whole without it.
void sync_folder(const std::filesystem::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

void check_place(const std::filesystem::path& file)
{
    if (!file.has_filename()) fail("write", file, "it names a folder; add a file name");
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status))
        fail("write", file, "a folder has that name; remove it or choose another");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        fail("write", file, "it is not a regular file and cannot be replaced; choose another name");
}

}  // namespace

AsideFile::AsideFile(const std::filesystem::path& file) : file_(resolved(file))
{
    check_place(file_);
    std::error_code error;
    std::filesystem::create_directories(folder_of(file_), error);
    if (error) fail("write", file_, fmt::format("its folder cannot be made ({})", error.message()));

    static std::atomic<unsigned> serial{0};
    int code = EEXIST;
    for (int attempt = 0; attempt < 100 && code == EEXIST; ++attempt)
    {
        aside_ = folder_of(file_) / fmt::format(".spindrift-{}-{}.part", ::getpid(), serial++);
        descriptor_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        code = descriptor_ < 0 ? errno : 0;
    }
    if (descriptor_ < 0) fail("write", file_, code);
}

AsideFile::~AsideFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!aside_.empty()) ::unlink(aside_.c_str());
}

void AsideFile::write(std::span<const std::byte> bytes)
{
    while (!bytes.empty())
    {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("write", file_, errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AsideFile::commit()
{
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) fail("write", file_, errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail("write", file_, errno);
    if (::rename(aside_.c_str(), file_.c_str()) != 0) fail("write", file_, errno);
    aside_.clear();
    sync_folder(folder_of(file_));
}

void write_whole(const std::filesystem::path& file, std::span<const std::byte> bytes)
{
    AsideFile aside(file);
    aside.write(bytes);
    aside.commit();
}

std::vector<std::byte> read_whole(const std::filesystem::path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail("read", file, errno);
    std::vector<std::byte> bytes;
    constexpr std::size_t kChunk = 1U << 16U;
    std::size_t size = 0;
    int code = 0;
    for (;;)
    {
        bytes.resize(size + kChunk);
        const ssize_t got = ::read(descriptor, bytes.data() + size, kChunk);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) code = errno;
        if (got <= 0) break;
        size += static_cast<std::size_t>(got);
    }
    ::close(descriptor);
    if (code != 0) fail("read", file, code);
    bytes.resize(size);
    return bytes;
}

}  // namespace spindrift::image
