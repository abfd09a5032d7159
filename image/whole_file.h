// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace spindrift::image
{

/// A file that appears under its name only when it is whole: made under another name in the same folder
/// (missing parent folders are created), renamed by commit(), removed by the destructor otherwise. A symbolic
/// link is followed. Every failure throws Error with the path and the system's reason; a folder or a device
/// in the file's place is one.
class AsideFile
{
  public:
    explicit AsideFile(const std::filesystem::path& file);
    ~AsideFile();
    AsideFile(const AsideFile&) = delete;
    AsideFile& operator=(const AsideFile&) = delete;

    const std::filesystem::path& file() const { return file_; }
    /// Where the bytes go until commit(); other programs may write there.
    const std::filesystem::path& aside() const { return aside_; }

    void write(std::span<const std::byte> bytes);
    /// Brings the bytes to the disk and gives the file its name.
    void commit();

  private:
    std::filesystem::path file_, aside_;
    int descriptor_ = -1;
};

void write_whole(const std::filesystem::path& file, std::span<const std::byte> bytes);
std::vector<std::byte> read_whole(const std::filesystem::path& file);

}  // namespace spindrift::image
