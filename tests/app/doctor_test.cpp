#include <gmock/gmock.h>

#include <fstream>

#include "app/doctor_checks.h"

namespace barehand {
namespace {

using Level = Finding::Level;

std::string write_file(const std::string& text) {
  const std::string path =
      ::testing::TempDir() + "doctor_" + ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::ofstream(path) << text;
  return path;
}

const std::string kColumns = "Iface\tDestination\tGateway\tFlags\tRefCnt\tUse\tMetric\tMask\tMTU\tWindow\tIRTT\n";

TEST(DoctorChecks, MulticastRoute) {
  const std::string subnet = "eth0\t0000A8C0\t00000000\t0001\t0\t0\t0\t00FFFFFF\t0\t0\t0\n";
  const std::string multicast = "lo\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n";
  const std::string by_default = "eth0\t00000000\t0100A8C0\t0003\t0\t0\t0\t00000000\t0\t0\t0\n";
  const auto check = [](const std::string& routes, const std::string& url = "udpm://239.255.76.67:7667?ttl=0") {
    return check_multicast_route(url, write_file(routes));
  };
  EXPECT_EQ(check(kColumns).level, Level::problem);
  EXPECT_EQ(check(kColumns + subnet).level, Level::problem);
  EXPECT_EQ(check(kColumns + subnet + multicast).text, "through lo");
  EXPECT_EQ(check(kColumns + by_default).text, "through eth0");
  EXPECT_EQ(check(kColumns, "memq://").level, Level::ok) << "not needed";
}

TEST(DoctorChecks, ReceiveBuffer) {
  const std::string udp = "udpm://239.255.76.67:7667?ttl=0", large = udp + "&recv_buf_size=8000000";
  const auto check = [](const std::string& url, const std::string& granted) {
    return check_receive_buffer(url, write_file(granted + "\n"));
  };
  EXPECT_EQ(check(udp, "212992").level, Level::warning);
  EXPECT_THAT(check(udp, "212992").remedy, ::testing::HasSubstr("net.core.rmem_max=2097152"));
  EXPECT_EQ(check(udp, "4194304").level, Level::ok);
  EXPECT_THAT(check(large, "4194304").remedy, ::testing::HasSubstr("net.core.rmem_max=8000000"));
  EXPECT_EQ(check("memq://", "212992").level, Level::ok);
  EXPECT_EQ(check_receive_buffer(udp, "/nonexistent").level, Level::note);
}

TEST(DoctorChecks, LcmInOneProcess) {
  EXPECT_EQ(check_lcm("memq://").level, Level::ok);
  EXPECT_EQ(check_lcm("nonsense://").level, Level::problem);
}

TEST(DoctorChecks, GraphicsSaysWhatIsThereAndWhetherItIsUsed) {
  const Finding found = check_graphics();
  EXPECT_THAT(found.text, ::testing::HasSubstr("OpenGL ES 3"));
  EXPECT_THAT(found.text, ::testing::HasSubstr("observer: auto"));
  const Finding absent = check_graphics("libnone.so.1");
  EXPECT_EQ(absent.level, Level::note);
  EXPECT_THAT(absent.text, ::testing::HasSubstr("libnone.so.1"));
}

TEST(DoctorChecks, ShippedFilesAreReadable) {
  for (const Finding& finding : check_files()) EXPECT_EQ(finding.level, Level::ok) << finding.subject << finding.text;
}

}  // namespace
}  // namespace barehand
