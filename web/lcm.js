// Decodes the LCM messages that the page needs (lcmtypes/*.lcm). LCM is big endian; a message starts with the
// fingerprint of its type (8 bytes). The decoders throw an error for a message of another type and for a damaged one.

const kFingerprints = {hand_state_t: 0x32c649d4163b8eb2n, glove_state_t: 0x5e477470f8db147en,
                       contact_state_t: 0xf0c0b3e2f622f768n, grasp_state_t: 0xd272e38d8b1abbe8n,
                       object_state_t: 0x455512028ee352e3n};

class Reader {
  constructor(view) { this.view = view; this.at = 8; }
  int8() { return this.view.getInt8(this.at++); }
  int32() { this.at += 4; return this.view.getInt32(this.at - 4); }
  int64() { this.at += 8; return Number(this.view.getBigInt64(this.at - 8)); }
  double() { this.at += 8; return this.view.getFloat64(this.at - 8); }
  doubles(count) { return Array.from({length: count}, () => this.double()); }
  int8s(count) { return Array.from({length: count}, () => this.int8()); }
  string() {
    const length = this.int32();
    if (length < 1 || this.at + length > this.view.byteLength) throw new RangeError("a text is too long");
    const bytes = new Uint8Array(this.view.buffer, this.view.byteOffset + this.at, length - 1);
    this.at += length;
    return new TextDecoder().decode(bytes);
  }
}

// Decodes a message of this type with `fields`, a function that reads the fields from a Reader.
function decode(type, view, fields) {
  if (view.byteLength < 8 || view.getBigUint64(0) !== kFingerprints[type])
    throw new TypeError(`it is no ${type} of this version`);
  const read = new Reader(view), message = fields(read);
  if (read.at !== view.byteLength) throw new RangeError(`it is too long for a ${type}`);
  return message;
}

function header(read) {
  return {utime: read.int64(), frame_number: read.int64(), sensor: read.string(), hand_id: read.int32(),
          handedness: read.int8(), status: read.int8()};
}

function segment(read) {
  return {position: read.doubles(3), orientation: read.doubles(4), distal: read.doubles(3),
          smoothed_position: read.doubles(3), smoothed_orientation: read.doubles(4), smoothed_distal: read.doubles(3),
          linear_velocity: read.doubles(3), angular_velocity: read.doubles(3), covariance: read.doubles(36),
          confidence: read.double(), visible: read.double(), seen: read.int8() !== 0};
}

// Decodes a hand_state_t; orientations are quaternions (w, x, y, z). `view`: a DataView of the whole message.
export function decodeHandState(view) {
  return decode("hand_state_t", view, (read) => ({
    ...header(read), has_pose: read.int8() !== 0, pose_utime: read.int64(), score: read.double(),
    joint_gap: read.double(), segments: Array.from({length: 16}, () => segment(read))}));
}

// Decodes a glove_state_t; angles are in radians, NaN if unknown.
export function decodeGloveState(view) {
  return decode("glove_state_t", view, (read) => ({
    ...header(read), joint_name: Array.from({length: 21}, () => read.string()), joint_angle: read.doubles(21),
    joint_angle_raw: read.doubles(21), joint_flag: read.int8s(21), channel: read.doubles(22),
    channel_raw: read.doubles(22), channel_flag: read.int8s(22)}));
}

function segmentContact(read) {
  return {state: read.int8(), inferred: read.int8() !== 0, probability: read.double(), distance: read.double(),
          deviation: read.double(), point: read.doubles(3), normal: read.doubles(3), point_in_object: read.doubles(3),
          normal_in_object: read.doubles(3), partner: read.int32(), segment: read.int8()};
}

// Decodes a contact_state_t; points are in the camera frame, in metres, NaN if unknown.
export function decodeContactState(view) {
  const contacts = (read) => Array.from({length: 16}, () => segmentContact(read));
  return decode("contact_state_t", view, (read) => ({
    ...header(read), object: contacts(read), own: contacts(read), other_hand: contacts(read)}));
}

// Decodes an object_state_t; its pose maps the object's frame to the camera's.
export function decodeObjectState(view) {
  return decode("object_state_t", view, (read) => ({
    utime: read.int64(), frame_number: read.int64(), sensor: read.string(), object_id: read.int32(),
    position: read.doubles(3), orientation: read.doubles(4), linear_velocity: read.doubles(3),
    angular_velocity: read.doubles(3), covariance: read.doubles(36), extent: read.doubles(3),
    held: read.int8() !== 0, hand_id: read.int32(), since: read.int64()}));
}

// Decodes a grasp_state_t; probabilities are NaN and classes negative where nothing is known.
export function decodeGraspState(view) {
  return decode("grasp_state_t", view, (read) => ({
    ...header(read), grasp: read.int8(), probability: read.double(), since: read.int64(),
    probabilities: read.doubles(18), kind: read.int8(), kind_probability: read.double(), opposition: read.int8(),
    opposition_probability: read.double(), thumb: read.int8(), thumb_probability: read.double(),
    first_finger: read.int8(), last_finger: read.int8(), finger_probability: read.double(), aperture: read.double(),
    closure: read.double()}));
}

export const kTouching = 3;  // state of a contact
export const kGraspNames = ["none", "wrap", "index extension", "thumb along", "ring", "sphere 3", "sphere 4", "extension",
  "adduction", "tripod variation", "lateral tripod", "lateral", "pinch", "tripod", "quadpod", "five fingers",
  "parallel extension", "writing tripod"];
export const kGraspKinds = ["none", "power", "intermediate", "precision"];
export const kSegmentNames = ["palm", ...["thumb", "index", "middle", "ring", "little"].flatMap((finger) =>
  (finger === "thumb" ? ["metacarpal", "proximal", "distal"] : ["proximal", "intermediate", "distal"])
    .map((bone) => `${finger} ${bone}`))];
export const kStatusNames = ["searching", "tracking", "holding", "lost"];
export const kSideNames = ["left", "right"];
export const kGloveChannels = ["thumb rotate", "thumb MPJ", "thumb IJ", "thumb abd", "index MPJ", "index PIJ",
  "index DIJ", "middle MPJ", "middle PIJ", "middle DIJ", "middle–index", "ring MPJ", "ring PIJ", "ring DIJ",
  "ring–middle", "little MPJ", "little PIJ", "little DIJ", "little–ring", "palm arch", "wrist pitch", "wrist yaw"];
