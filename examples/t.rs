use liouville::case::Case;
use liouville::flow::*;
use liouville::number::pair::Pair;
use std::time::Instant;
fn f2(x: &[Pair]) -> (f64, f64, f64) {
    // crude in f64
    let m=1.3; let r0=3.0; let c=[0.7,-0.4,1.1]; let i=[2.6,1.2,1.8];
    let w=[x[0].hi,x[1].hi,x[2].hi]; let g=[x[3].hi,x[4].hi,x[5].hi];
    let r:[f64;3]=std::array::from_fn(|k| -r0*g[k]-c[k]);
    let r2:f64=r.iter().map(|x|x*x).sum(); let rw:f64=(0..3).map(|k|r[k]*w[k]).sum();
    let j:[f64;3]=std::array::from_fn(|k| i[k]*w[k]+m*(r2*w[k]-rw*r[k]));
    let e:f64=(0..3).map(|k|j[k]*w[k]).sum();
    let cr=[j[1]*g[2]-j[2]*g[1],j[2]*g[0]-j[0]*g[2],j[0]*g[1]-j[1]*g[0]];
    let f:f64=cr.iter().map(|x|x*x).sum::<f64>()-2.0*m*r0*(0..3).map(|k|g[k]*c[k]).sum::<f64>()*e;
    (e/2.0,f,(0..3).map(|k|w[k]*g[k]).sum())
}
fn main() {
    let case = Case::parse("title = 'W1'\nsystem = 'rubber-plane'\n[parameters]\nm = 1.3\nR = 3\nc = [0.7, -0.4, 1.1]\nI = [2.6, 1.2, 1.8]\n[body]\nshape = 'ball'\n", &[]).unwrap();
    let program = program(&case.model, &[], |_| vec![]).unwrap();
    println!("{} instr {} products", program.instructions(), program.products());
    if std::env::args().count()>2 { println!("{program:#?}"); }
    let start: Vec<Pair> = [0.5f64, 0.5, -0.5, 0.6, 0.0, 0.6].iter().map(|x| Pair::from_f64(*x)).collect();
    let n=(start[3].hi.powi(2)*2.0).sqrt();
    let start: Vec<Pair> = start.iter().enumerate().map(|(i,x)| if i>=3 {Pair::from_f64(x.hi/n)} else {Pair::from_f64([0.5,0.7,-0.5][i])}).collect();
    for _ in 0..5 {
    let t0=Instant::now();
    let mut s = Stepper::<f64>::new(&program, Accuracy::FLOAT);
    s.start(0,&start,Pair::from_f64(1000.0));
    let mut k=0;
    loop { s.expand(); s.check(0).unwrap(); s.advance(); k+=1; if s.is_done(0) {break;} }
    let dt=t0.elapsed().as_secs_f64();
    let a=f2(&start); let b=f2(&s.pairs(0));
    println!("{dt} s {k} steps {} us/step  E {:e} F2 {:e} {:e}", dt/k as f64*1e6, b.0/a.0-1.0, b.1/a.1-1.0, b.2);
    }
    let t0=Instant::now();
    let mut s = Stepper::<Lanes<8>>::new(&program, Accuracy::FLOAT);
    for l in 0..8 {s.start(l,&start,Pair::from_f64(1000.0));}
    let mut k=0;
    loop { s.expand(); s.check(0).unwrap(); s.advance(); k+=1; if s.is_done(0) {break;} }
    let dt=t0.elapsed().as_secs_f64();
    println!("lanes {} s/orbit {} us/orbit-step", dt/8.0, dt/8.0/k as f64*1e6);
    let t0=Instant::now();
    if std::env::args().count()<2 {return;} let mut s = Stepper::<Pair>::new(&program, Accuracy::PAIR);
    s.start(0,&start,Pair::from_f64(1000.0));
    let mut k=0;
    loop { s.expand(); s.check(0).unwrap(); s.advance(); k+=1; if s.is_done(0) {break;} }
    let dt=t0.elapsed().as_secs_f64();
    println!("pair {} s {k} steps  {:?}", dt, s.pairs(0));
}
