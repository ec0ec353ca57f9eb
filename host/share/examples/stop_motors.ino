// Two motors of an H-bridge turn while Fencepost's heartbeat, on Serial1, says that the robot may drive.
const int kEnable[] = {5, 6};  // ENA and ENB of the bridge; IN1 to IN4 are wired for ahead
unsigned long heard = 0, asked = 0;
bool may = false;
String line;
void setup() {
  for (int pin : kEnable) pinMode(pin, OUTPUT);
  Serial1.begin(115200);
}
void loop() {  // $FPALV,12.4000,warn,ok,ok*703A: time, level, camera, odometry
  for (; Serial1.available() > 0; line = line.length() < 99 && !line.endsWith("\n") ? line : String()) {
    line += char(Serial1.read());
    if (!line.startsWith("$FPALV,") || !line.endsWith("\n")) continue;
    heard = millis();
    may = line.indexOf(",stop,") < 0 && line.indexOf(",blind,") < 0 && (line.indexOf(",ok,ok*") > 0 || line.indexOf(",empty,ok*") > 0);
  }
  if (millis() - heard > 300) may = false;
  if (millis() - heard > 300 && millis() - asked > 1000) asked = millis(), Serial1.print("\rmode log\r");
  for (int pin : kEnable) analogWrite(pin, may ? 120 : 0);
}
