#include "drivers/openni2/usb_bus.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"

namespace barehand {
namespace {

using test::TempFolder;
using test::write_text;

void plug(const TempFolder& bus, const std::string& port, int number) {
  std::filesystem::create_directories(bus / port);
  write_text(bus / port + "/devnum", std::to_string(number) + "\n");
}

TEST(UsbBusState, ChangesWithEveryPlug) {
  const TempFolder bus;
  plug(bus, "1-1", 2);
  const std::string before = usb_bus_state(bus.path());
  EXPECT_EQ(usb_bus_state(bus.path()), before);
  plug(bus, "1-2", 3);
  const std::string with_sensor = usb_bus_state(bus.path());
  EXPECT_NE(with_sensor, before);
  plug(bus, "1-2", 4);  // pulled and put into the same port between two looks
  EXPECT_NE(usb_bus_state(bus.path()), with_sensor);
}

TEST(UsbBusState, AMachineWithoutABusSaysNothing) { EXPECT_EQ(usb_bus_state("/nonexistent"), ""); }

}  // namespace
}  // namespace barehand
