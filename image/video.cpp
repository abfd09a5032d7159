// SPDX-License-Identifier: MIT
#include "image/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "image/whole_file.h"

extern char** environ;

namespace spindrift::image
{

namespace
{

class Descriptor
{
  public:
    explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    int get() const { return descriptor_; }
    void close()
    {
        if (descriptor_ >= 0) ::close(descriptor_);
        descriptor_ = -1;
    }

  private:
    int descriptor_;
};

std::vector<std::string> ffmpeg_arguments(const std::filesystem::path& to, int width, int height,
                                          double frames_per_s)
{
    // A colon in a relative name would read as a protocol; an absolute path behind file: cannot.
    const std::string target = "file:" + std::filesystem::absolute(to).string();
    return {"ffmpeg",
            "-hide_banner",
            "-nostdin",
            "-nostats",
            "-loglevel",
            "error",
            "-xerror",
            "-y",
            "-f",
            "rawvideo",
            "-pixel_format",
            "rgb24",
            "-video_size",
            fmt::format("{}x{}", width, height),
            "-framerate",
            fmt::format("{}", frames_per_s),
            "-i",
            "pipe:0",
            "-vf",
            "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
            "-c:v",
            "libx264",
            "-preset",
            "fast",
            "-crf",
            "18",
            "-color_range",
            "tv",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "iec61966-2-1",
            "-movflags",
            "+faststart",
            "-f",
            "mp4",
            target};
}

/// Settings of the child: its own process group, so that a Ctrl-C at the terminal ends the run and not the
/// encoder; no inherited mask or ignored SIGPIPE.
class SpawnSettings
{
  public:
    SpawnSettings(int input, int messages)
    {
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes,
                                 POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        posix_spawnattr_setpgroup(&attributes, 0);
        sigset_t none, defaults;
        sigemptyset(&none);
        sigemptyset(&defaults);
        sigaddset(&defaults, SIGPIPE);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &defaults);
    }
    ~SpawnSettings()
    {
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
};

class VideoWriter final : public FrameWriter
{
  public:
    VideoWriter(const std::filesystem::path& file, int width, int height, double frames_per_s)
        : file_(file), width_(width), height_(height), aside_(std::make_unique<AsideFile>(file))
    {
        start(ffmpeg_arguments(aside_->aside(), width, height, frames_per_s));
    }

    ~VideoWriter() override
    {
        if (child_ <= 0) return;
        ::kill(child_, SIGKILL);
        wait();
    }

    bool wants_linear() const override { return false; }
    bool keeps_last_only() const override { return false; }
    void add(const Image&) override { throw std::logic_error("a video takes display pictures"); }

    void add(const Image8& picture) override
    {
        if (picture.width != width_ || picture.height != height_)
            throw Error(fmt::format("{}: a frame of {}x{} pixels does not fit a video of {}x{}",
                                    file_.string(), picture.width, picture.height, width_, height_));
        const unsigned char* bytes = picture.rgb.data();
        std::size_t left = picture.rgb.size();
        while (left > 0)
        {
            // A socket rather than a pipe: an encoder that died answers with EPIPE and no signal.
            const ssize_t sent = ::send(input_.get(), bytes, left, MSG_NOSIGNAL);
            if (sent < 0 && errno == EINTR) continue;
            if (sent < 0) fail_with_messages();
            bytes += sent;
            left -= static_cast<std::size_t>(sent);
        }
        ++frames_;
    }

    void finish() override
    {
        if (child_ <= 0) return;
        input_.close();
        if (frames_ == 0)  // an interrupt before the first frame: there is no video to keep
        {
            wait();
            aside_.reset();
            return;
        }
        const int status = wait();
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail("ffmpeg " + ended(status));
        aside_->commit();
    }

  private:
    void start(std::vector<std::string> arguments)
    {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(system_reason(errno));
        input_ = Descriptor(ends[0]);
        const Descriptor child_end(ends[1]);
        messages_ = Descriptor(::memfd_create("ffmpeg messages", MFD_CLOEXEC));
        if (messages_.get() < 0) fail(system_reason(errno));

        const SpawnSettings settings(child_end.get(), messages_.get());
        std::vector<char*> list;
        for (std::string& argument : arguments) list.push_back(argument.data());
        list.push_back(nullptr);
        const int code =
            ::posix_spawnp(&child_, "ffmpeg", &settings.actions, &settings.attributes, list.data(), environ);
        if (code == 0) return;
        child_ = -1;
        if (code == ENOENT)
            fail(
                "the program ffmpeg, which encodes it, is not found; install the package ffmpeg or write "
                "pictures (NAME_%04d.png)");
        fail("ffmpeg does not start: " + system_reason(code));
    }

    int wait()
    {
        int status = 0;
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR)
        {
        }
        child_ = -1;
        return status;
    }

    static std::string system_reason(int code) { return std::generic_category().message(code); }

    static std::string ended(int status)
    {
        if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
        return fmt::format("ended with code {}", WEXITSTATUS(status));
    }

    [[noreturn]] void fail_with_messages()
    {
        input_.close();
        fail("ffmpeg " + ended(wait()));
    }

    [[noreturn]] void fail(const std::string& why)
    {
        std::string said = last_messages();
        throw Error(fmt::format("{}: cannot write: {}{}{}", file_.string(), why,
                                said.empty() ? "" : "; it said: ", said));
    }

    /// The end of what ffmpeg wrote to its stderr, on one line.
    std::string last_messages() const
    {
        if (messages_.get() < 0) return {};
        constexpr off_t kMost = 2000;
        const off_t size = ::lseek(messages_.get(), 0, SEEK_END);
        const off_t from = size > kMost ? size - kMost : 0;
        std::string text(static_cast<std::size_t>(size > from ? size - from : 0), ' ');
        const ssize_t got = ::pread(messages_.get(), text.data(), text.size(), from);
        text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
        while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
        for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
        return text;
    }

    std::filesystem::path file_;
    int width_, height_;
    std::unique_ptr<AsideFile> aside_;
    Descriptor input_, messages_;
    pid_t child_ = -1;
    std::uint64_t frames_ = 0;
};

}  // namespace

std::unique_ptr<FrameWriter> make_video_writer(const std::filesystem::path& file, int width, int height,
                                               double frames_per_s)
{
    return std::make_unique<VideoWriter>(file, width, height, frames_per_s);
}

}  // namespace spindrift::image
