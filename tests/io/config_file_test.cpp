#include "io/config/config_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "io/config/config_writer.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Inner {
  double sigma_obs = 0.004;
  std::vector<double> widths = {0.008, 0.1};
};
template <class V>
void visit(V& v, Inner& p) {
  v("sigma_obs", p.sigma_obs, 1e-4, 0.1, "m, accuracy of the depth");
  v("widths", p.widths, 0, 1, "m and rad");
}

struct Outer {
  int levels = 10;
  std::int64_t seed = 1;
  bool enabled = true;
  std::string mode = "auto", name = "left \"A\"";
  Inner inner;
};
template <class V>
void visit(V& v, Outer& p) {
  v.user("levels", p.levels, 1, 100, "hierarchy levels");
  v.retired("depth", "levels");
  v.without_effect("magic");
  v("seed", p.seed, 0, std::numeric_limits<std::int64_t>::max(), "of the random numbers");
  v.formerly("active");
  v("enabled", p.enabled, "what it does");
  v("mode", p.mode, {"auto", "cpu"}, "which way");
  v("name", p.name, "free text");
  v("inner", p.inner, "the inner group");
}

class ConfigFile : public ::testing::Test {
 protected:
  const test::TempFolder folder_;
  const std::string path_ = folder_ / "config.yaml";
  const std::string good_ = print_config(Outer{});

  Result<Outer> load(const std::string& text) {
    test::write_text(path_, text);
    return load_config<Outer>(path_);
  }
  /// The complete file with one piece of text replaced.
  std::string with(const std::string& from, const std::string& to) {
    std::string text = good_;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  std::string error_of(const std::string& text) {
    const auto config = load(text);
    return config ? "no error" : config.error().message();
  }
  std::string place(const std::string& text, const std::string& piece) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(piece));
    return path_ + ":" + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": ";
  }
};

TEST_F(ConfigFile, AnOlderNameOfAKeyIsReadButNotPrinted) {
  const auto read = load(with("enabled: true", "active: false"));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_FALSE(read->enabled);
  EXPECT_THAT(print_config(*read), AllOf(HasSubstr("enabled: false"), Not(HasSubstr("active"))));

  EXPECT_THAT(error_of(with("enabled: true", "active: maybe")),
              HasSubstr("'active' is 'maybe', but must be true or false"));
  EXPECT_THAT(error_of(with("enabled: true", "enabled: true\nactive: true")),
              HasSubstr("'active' is now 'enabled', give that alone"));
}

TEST_F(ConfigFile, PrintedConfigReadsBackExactly) {
  Outer config;
  config.levels = 3;
  config.seed = std::numeric_limits<std::int64_t>::max();
  config.enabled = false;
  config.mode = "cpu";
  config.name = "a: # \"b\" \\";
  config.inner.sigma_obs = 0.1 / 3;
  config.inner.widths = {};
  const auto read = load(print_config(config));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->levels, 3);
  EXPECT_EQ(read->seed, config.seed);
  EXPECT_FALSE(read->enabled);
  EXPECT_EQ(read->mode, "cpu");
  EXPECT_EQ(read->name, config.name);
  EXPECT_EQ(read->inner.sigma_obs, 0.1 / 3);
  EXPECT_TRUE(read->inner.widths.empty());
}

TEST_F(ConfigFile, PrintedConfigSaysWhatKeysMean) {
  EXPECT_THAT(good_, HasSubstr("# m, accuracy of the depth [1e-04 .. 0.1]\n  sigma_obs: 0.004\n"));
  EXPECT_THAT(good_, HasSubstr("# which way [auto | cpu]\nmode: \"auto\"\n"));
}

TEST_F(ConfigFile, UnknownKeyIsAnErrorWithLineAndSuggestion) {
  const std::string text = with("  sigma_obs: 0.004", "  sigma_obs: 0.004\n  sigma_ob: 1");
  EXPECT_EQ(error_of(text),
            place(text, "sigma_ob: 1") + "unknown key 'inner.sigma_ob', did you mean 'inner.sigma_obs'?");
}

TEST_F(ConfigFile, UnknownKeyWithoutAnythingNearGetsNoSuggestion) {
  EXPECT_THAT(error_of(good_ + "zzzzzzzz: 1\n"), Not(HasSubstr("did you mean")));
}

TEST_F(ConfigFile, KeysThatAreNotGivenKeepTheirDefaults) {
  const auto read = load("inner:\n  sigma_obs: 0.05\n");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->inner.sigma_obs, 0.05);
  EXPECT_EQ(read->inner.widths, Inner{}.widths);
  EXPECT_EQ(read->levels, 10);
  EXPECT_EQ(load("levels: 3\n")->inner.sigma_obs, 0.004) << "a whole group may be left out";
}

TEST_F(ConfigFile, UserKeysArePrintedAndWhatElseWasChanged) {
  Outer config;
  EXPECT_EQ(print_config(config, ConfigKeys::user), "# hierarchy levels [1 .. 100]\nlevels: 10\n");
  config.inner.sigma_obs = 0.01;
  EXPECT_EQ(print_config(config, ConfigKeys::user),
            "# hierarchy levels [1 .. 100]\nlevels: 10\n\n# the inner group\ninner:\n"
            "  # m, accuracy of the depth [1e-04 .. 0.1]\n  sigma_obs: 0.01\n");
  EXPECT_EQ(print_config(config, ConfigKeys::changed),
            "inner:\n  # m, accuracy of the depth [1e-04 .. 0.1]\n  sigma_obs: 0.01\n");
  EXPECT_EQ(load(print_config(config, ConfigKeys::user))->inner.sigma_obs, 0.01);
}

/// Files written before a key was replaced contain the old key and the new one.
TEST_F(ConfigFile, ARetiredKeyIsReadWhereItAgreesWithItsSuccessor) {
  EXPECT_TRUE(load(good_ + "depth: 10\n")) << "levels is 10, too";
  EXPECT_EQ(error_of(good_ + "depth: 9\n"),
            place(good_ + "depth: 9\n", "depth: 9") + "'depth' is now 'levels', give that alone");
  EXPECT_THAT(error_of("depth: 10\n"), HasSubstr("'depth' is now 'levels'"));
  EXPECT_THAT(good_, Not(HasSubstr("depth: ")));
}

TEST_F(ConfigFile, AKeyThatHasNoEffectAnyMoreIsReadAndNamedInOneLine) {
  const auto printed = [&](const std::string& text) {
    ::testing::internal::CaptureStderr();
    const auto read = load(text);
    EXPECT_TRUE(read) << read.error().message();
    return ::testing::internal::GetCapturedStderr();
  };
  const std::string text = printed("seed: 5\nmagic: 2\n");
  EXPECT_THAT(text, HasSubstr(path_ + ":2: 'magic' has no effect any more, leave it out\n"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);

  EXPECT_EQ(printed(good_), "");
  EXPECT_THAT(good_, Not(HasSubstr("magic")));
}

TEST_F(ConfigFile, MistypedValuesAreErrors) {
  for (const char* bad : {"ten", "10.5", "\"10\"", "[1]", "", "{a: 1}"})
    EXPECT_THAT(error_of(with("levels: 10", std::string("levels: ") + bad)), HasSubstr("a whole number from 1 to 100"))
        << bad;
  EXPECT_THAT(error_of(with("sigma_obs: 0.004", "sigma_obs: thin")), HasSubstr("'thin'"));
  EXPECT_THAT(error_of(with("enabled: true", "enabled: 7")), HasSubstr("true or false"));
  EXPECT_THAT(error_of(with("mode: \"auto\"", "mode: gpu")), HasSubstr("one of auto, cpu"));
  EXPECT_THAT(error_of(with("widths: [0.008, 0.1]", "widths: [0.008, x]")), HasSubstr("'inner.widths'"));
  EXPECT_THAT(error_of(with("widths: [0.008, 0.1]", "widths: 3")), HasSubstr("a list of numbers"));
}

TEST_F(ConfigFile, ValuesOutOfRangeAreErrors) {
  for (const char* bad : {"0", "101", "-3", "99999999999999999999"})
    EXPECT_THAT(error_of(with("levels: 10", std::string("levels: ") + bad)), HasSubstr("'levels'")) << bad;
  for (const char* bad : {"0", "0.2", ".nan", ".inf", "-0.004"})
    EXPECT_THAT(error_of(with("sigma_obs: 0.004", std::string("sigma_obs: ") + bad)), HasSubstr("'inner.sigma_obs'"))
        << bad;
  EXPECT_THAT(error_of(with("[0.008, 0.1]", "[0.008, 1.5]")), HasSubstr("'1.5'"));
}

TEST_F(ConfigFile, DoubledKeyIsAnError) {
  EXPECT_THAT(error_of(good_ + "levels: 4\n"), HasSubstr("key 'levels' occurs twice"));
}

TEST_F(ConfigFile, ASecondDocumentIsAnError) {
  for (const char* rest : {"---\nlevels: 4\n", "...\nlevels: 4\n"})
    EXPECT_THAT(error_of("levels: 3\n" + std::string(rest)), HasSubstr(path_ + ":3: a second document begins")) << rest;
  EXPECT_THAT(error_of("levels: 3\n...\nlevels: {4\n"), HasSubstr("not valid YAML"));
  EXPECT_TRUE(load("---\nlevels: 3\n...\n"));
}

TEST_F(ConfigFile, AllProblemsAreToldAtOnceInOrderOfLines) {
  std::string text = with("levels: 10", "levels: ten");
  text += "lost: 1\n";
  EXPECT_THAT(error_of(text), ::testing::MatchesRegex("(.|\n)*levels(.|\n)*unknown key 'lost'(.|\n)*"));
}

TEST_F(ConfigFile, UnreadableFilesAreErrors) {
  EXPECT_THAT(load_config<Outer>("/nonexistent/a.yaml").error().message(), HasSubstr("/nonexistent/a.yaml"));
  EXPECT_THAT(error_of("levels: [1\nmode"), HasSubstr("not valid YAML"));
  EXPECT_THAT(error_of(""), HasSubstr("no keys"));
  EXPECT_THAT(error_of("just text"), HasSubstr("no keys"));
}

/// Reads a configuration file of these bytes. Returns the value of its key "levels", or the error message.
std::string levels_of(const std::string& bytes) {
  const test::TempFolder folder;
  test::write_text(folder / "config.yaml", bytes);
  const auto config = load_config<Outer>(folder / "config.yaml");
  return config ? std::to_string(config->levels) : config.error().message();
}

TEST(ConfigReader, ReadsAFileHoweverItsEditorWritesText) {
  Outer config;
  config.levels = 7;
  const std::string text = print_config(config);
  std::string windows = "\xef\xbb\xbf", utf16 = "\xff\xfe";
  for (const char c : text) {
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    utf16.append(1, c).append(1, '\0');
  }
  EXPECT_EQ(levels_of(text), "7");
  EXPECT_EQ(levels_of(windows), "7");
  EXPECT_THAT(levels_of(utf16), HasSubstr("is UTF-16"));
}

}  // namespace
}  // namespace barehand
