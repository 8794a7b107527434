#include <gmock/gmock.h>

#include "app/doctor/doctor_checks.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using Level = Finding::Level;

class DoctorChecks : public ::testing::Test {
 protected:
  std::string file(const std::string& text) const {
    test::write_text(folder_ / "file", text);
    return folder_ / "file";
  }
  const test::TempFolder folder_;
};

const std::string kColumns = "Iface\tDestination\tGateway\tFlags\tRefCnt\tUse\tMetric\tMask\tMTU\tWindow\tIRTT\n";

TEST_F(DoctorChecks, MulticastRoute) {
  const std::string subnet = "eth0\t0000A8C0\t00000000\t0001\t0\t0\t0\t00FFFFFF\t0\t0\t0\n";
  const std::string multicast = "lo\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n";
  const std::string by_default = "eth0\t00000000\t0100A8C0\t0003\t0\t0\t0\t00000000\t0\t0\t0\n";
  const auto check = [&](const std::string& routes, const std::string& url = "udpm://239.255.76.67:7667?ttl=0") {
    return check_multicast_route(url, file(routes));
  };
  EXPECT_EQ(check(kColumns).level, Level::problem);
  EXPECT_EQ(check(kColumns + subnet).level, Level::problem);
  EXPECT_EQ(check(kColumns + subnet + multicast).text, "through lo");
  EXPECT_EQ(check(kColumns + by_default).text, "through eth0");
  EXPECT_EQ(check(kColumns, "memq://").level, Level::ok) << "not needed";
}

TEST_F(DoctorChecks, ReceiveBuffer) {
  const std::string udp = "udpm://239.255.76.67:7667?ttl=0", large = udp + "&recv_buf_size=8000000";
  const auto check = [&](const std::string& url, const std::string& granted) {
    return check_receive_buffer(url, file(granted + "\n"));
  };
  EXPECT_EQ(check(udp, "212992").level, Level::warning);
  EXPECT_THAT(check(udp, "212992").remedy, ::testing::HasSubstr("net.core.rmem_max=2097152"));
  EXPECT_EQ(check(udp, "4194304").level, Level::ok);
  EXPECT_THAT(check(large, "4194304").remedy, ::testing::HasSubstr("net.core.rmem_max=8000000"));
  EXPECT_EQ(check("memq://", "212992").level, Level::ok);
  EXPECT_EQ(check_receive_buffer(udp, "/nonexistent").level, Level::note);
}

TEST_F(DoctorChecks, LcmInOneProcess) {
  EXPECT_EQ(check_lcm("memq://").level, Level::ok);
  EXPECT_EQ(check_lcm("nonsense://").level, Level::problem);
}

TEST_F(DoctorChecks, GraphicsSaysWhatIsThereAndWhetherItIsUsed) {
  const Finding found = check_graphics();
  EXPECT_THAT(found.text, ::testing::HasSubstr("OpenGL ES 3"));
  EXPECT_THAT(found.text, ::testing::HasSubstr("observer: auto"));
  EXPECT_THAT(found.text, ::testing::ContainsRegex("640 samples: a call takes [0-9.]+ ms on the CPU and [0-9.]+ ms on "
                                                   "the device, which is [0-9.]+ times as"));
  const Finding absent = check_graphics("libnone.so.1");
  EXPECT_EQ(absent.level, Level::note);
  EXPECT_THAT(absent.text, ::testing::HasSubstr("libnone.so.1"));
}

TEST_F(DoctorChecks, ShippedFilesAreReadable) {
  for (const Finding& finding : check_files()) EXPECT_EQ(finding.level, Level::ok) << finding.subject << finding.text;
}

}  // namespace
}  // namespace barehand
