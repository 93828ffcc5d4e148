// SPDX-License-Identifier: Apache-2.0
#include "io/bake_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>
#include <fstream>

#include "base/files/output_file.h"
#include "io/bake_writer.h"
#include "sample_crowd.h"

namespace throng::io {
namespace {

using test::contentOf;
using test::SampleCrowd;
using test::SampleOptions;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

/// While it lives, files can grow to `bytes` only, as on a full disk; the error is EFBIG.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        ::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

void makeBake(const std::filesystem::path& path, const std::string& content, bool force = false) {
    BakeFolder folder(path, force);
    writeFile(folder.path() / "bake.json", content);
    folder.commit();
}

std::string errorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const OutputError& error) {
        return error.what();
    }
    return {};
}

TEST(BakeFolder, HasItsNameOnlyOnceItIsCommitted) {
    const TemporaryFolder outer;
    {
        BakeFolder folder(outer / "bake", false);
        writeFile(folder.path() / "bake.json", "{}");
        ASSERT_EQ(outer.names().size(), 1u);
        EXPECT_TRUE(outer.names().front().starts_with("bake.tmp-"));
        EXPECT_EQ(folder.commit(), outer / "bake");
    }
    EXPECT_EQ(outer.names(), Names{"bake"});
    EXPECT_EQ(contentOf(outer / "bake" / "bake.json"), "{}");
}

TEST(BakeFolder, IsReadableByOthersAsTheUmaskSays) {
    const TemporaryFolder outer;
    const mode_t before = ::umask(0027);
    makeBake(outer / "bake", "{}");
    ::umask(before);
    const auto mode = [&](const std::string& name) {
        struct stat facts {};
        ::stat((outer / name).c_str(), &facts);
        return facts.st_mode & 0777;
    };
    EXPECT_EQ(mode("bake"), 0750u);
    EXPECT_EQ(mode("bake/bake.json"), 0640u);
}

TEST(BakeFolder, LeavesNothingWhenItIsNotCommitted) {
    const TemporaryFolder outer;
    {
        BakeFolder folder(outer / "bake", false);
        folder.addFolder("streams");
        writeFile(folder.path() / "streams" / "pos.npy", "data");
    }
    EXPECT_EQ(outer.names(), Names{});
}

TEST(BakeFolder, CreatesParentsAndForgivesATrailingSlash) {
    const TemporaryFolder outer;
    makeBake(outer.path() / "shots" / "one/", "{}");
    EXPECT_TRUE(std::filesystem::exists(outer.path() / "shots" / "one" / "bake.json"));
    EXPECT_NE(errorOf([&] { BakeFolder(outer.path() / "..", false); }), "");
}

TEST(BakeFolder, NeverReplacesAnExistingBakeUnlessForced) {
    const TemporaryFolder outer;
    makeBake(outer / "bake", "old");
    EXPECT_NE(errorOf([&] { BakeFolder(outer / "bake", false); }).find("exists"), std::string::npos);
    EXPECT_EQ(outer.names(), Names{"bake"});
    EXPECT_EQ(contentOf(outer / "bake" / "bake.json"), "old");
    makeBake(outer / "bake", "new", true);
    EXPECT_EQ(outer.names(), Names{"bake"});
    EXPECT_EQ(contentOf(outer / "bake" / "bake.json"), "new");
}

TEST(BakeFolder, DoesNotReplaceABakeThatAppearedMeanwhile) {
    const TemporaryFolder outer;
    {
        BakeFolder folder(outer / "bake", false);
        writeFile(folder.path() / "bake.json", "late");
        makeBake(outer / "bake", "first");
        EXPECT_NE(errorOf([&] { folder.commit(); }).find("will not be replaced"), std::string::npos);
    }
    EXPECT_EQ(outer.names(), Names{"bake"});
    EXPECT_EQ(contentOf(outer / "bake" / "bake.json"), "first");
}

TEST(BakeFolder, ReplacesOnlyBakesAndEmptyFoldersEvenWhenForced) {
    const TemporaryFolder outer;
    std::filesystem::create_directory(outer / "photos");
    writeFile(outer / "photos" / "holiday.jpg", "precious");
    EXPECT_NE(errorOf([&] { BakeFolder(outer / "photos", true); }).find("not a bake"), std::string::npos);
    writeFile(outer / "file", "text");
    EXPECT_NE(errorOf([&] { BakeFolder(outer / "file", true); }), "");
    makeBake(outer / "bake", "linked");
    std::filesystem::create_symlink(outer / "bake", outer / "link");
    EXPECT_NE(errorOf([&] { BakeFolder(outer / "link", true); }), "");
    std::filesystem::create_directory(outer / "empty");
    makeBake(outer / "empty", "filled", true);
    EXPECT_EQ(outer.names(), (Names{"bake", "empty", "file", "link", "photos"}));
    EXPECT_EQ(contentOf(outer / "photos" / "holiday.jpg"), "precious");
}

TEST(BakeFolder, KeepsEveryPartialBake) {
    const TemporaryFolder outer;
    for (const char* expected : {"bake.partial", "bake.partial-2", "bake.partial-3"}) {
        BakeFolder folder(outer / "bake", false);
        writeFile(folder.path() / "bake.json", expected);
        EXPECT_EQ(folder.commitPartial(), outer / expected);
        EXPECT_EQ(contentOf(outer / expected / "bake.json"), expected);
    }
    EXPECT_EQ(outer.names().size(), 3u);
}

TEST(BakeFolder, SaysWhyItCannotBeMade) {
    const TemporaryFolder outer;
    writeFile(outer / "file", "text");
    EXPECT_NE(errorOf([&] { BakeFolder(outer / "file" / "bake", false); }), "");
    const std::string message = errorOf([] { BakeFolder("/proc/bake", false); });
    EXPECT_NE(message.find("/proc/bake"), std::string::npos) << message;
}

TEST(OutputFile, TellsAboutAFullDevice) {
    const TemporaryFolder outer;
    // Creating exclusively through a link fails, so the limit stands in for the full device.
    const FileSizeLimit limit(10);
    OutputFile file(outer / "file");
    file.write("0123456789");
    try {
        file.write("x");
        FAIL() << "nobody noticed";
    } catch (const OutputError& error) {
        EXPECT_EQ(error.errorNumber(), EFBIG);
        EXPECT_EQ(error.path(), outer / "file");
        EXPECT_NE(std::string(error.what()).find("cannot write " + (outer / "file").string()),
                  std::string::npos);
    }
}

/// The limits lie in the header, within the frames, and beyond the streams, where the glTF file or the images
/// fail.
TEST(BakeWriter, LeavesNothingBehindWhenAWriteFails) {
    SampleOptions options;
    options.rows = 200;
    options.frames = 12;
    options.diagram_every = 6;
    const SampleCrowd crowd(options);
    const TemporaryFolder reference;
    crowd.bake(reference / "bake");
    std::uintmax_t largest = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(reference / "bake"))
        if (entry.is_regular_file()) largest = std::max(largest, entry.file_size());
    ASSERT_GT(largest, 200u * 12u * 12u + 128u) << "the largest file should not be a stream";

    for (const rlim_t limit : {rlim_t{0}, rlim_t{20}, rlim_t{100}, rlim_t{2'000}, rlim_t{20'000},
                               rlim_t{200 * 12 * 12 + 128}, rlim_t{largest - 1}}) {
        const TemporaryFolder outer;
        std::string message;
        {
            const FileSizeLimit full(limit);
            message = errorOf([&] { crowd.bake(outer / "bake"); });
        }
        EXPECT_NE(message.find("File too large"), std::string::npos) << limit << " bytes: " << message;
        EXPECT_EQ(outer.names(), Names{}) << limit << " bytes";
    }
    const TemporaryFolder outer;
    const FileSizeLimit just_enough(largest);
    EXPECT_EQ(errorOf([&] { crowd.bake(outer / "bake"); }), "");
}

}  // namespace
}  // namespace throng::io
