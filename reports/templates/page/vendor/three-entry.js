// What solid.js uses of three.js; bundle.sh makes three.min.js of it.
export {
  AmbientLight, BackSide, BufferAttribute, BufferGeometry, DirectionalLight, DoubleSide, FrontSide, GreaterDepth,
  LessEqualDepth, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, OrthographicCamera,
  Points, PointsMaterial, Scene, WebGLRenderer,
} from "three";
