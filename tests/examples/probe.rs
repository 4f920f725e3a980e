use npr_tests::*;
fn main(){
 let mut s=lines("filter");
 for k in ["detect.depth.on=false","detect.normal.on=false","detect.object.on=false","detect.material.on=false"]{s.set(k).unwrap();}
 let f=draw(&asset("teapot_box_plane.glb"),&s,[960,540]); write_png("/tmp/probe/piece.png".as_ref(),&f).unwrap();
 for m in ["shape","okuya","filter","hull","filter+hull","edges","angle"]{ let mut s=lines(m); s.set("line.width.base=6px").unwrap(); s.set("line.width.source=curvature").unwrap();s.set("line.width.min=0.3").unwrap();s.set("line.width.max=2").unwrap();
 let f=draw(&asset("teapot_box_plane.glb"),&s,[960,540]); write_png(format!("/tmp/probe/{m}.png").as_ref(),&f).unwrap();}
}
