//! A box of 6 x 4 x 20 cm, inside spheres, capsules and a box.
mod foam;

fn main() -> Result<(), String> {
    let vertices: Vec<[f64; 3]> = (0..8)
        .map(|i| {
            let at = |bit: i32, half: f64| if i & bit != 0 { half } else { -half };
            [at(1, 0.03), at(2, 0.02), at(4, 0.1)]
        })
        .collect();
    let triangles = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                     [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]];
    let region = foam::Region::of_mesh(&vertices, &triangles)?;
    println!("foam {}", foam::version());
    for (count, kinds) in [(8, foam::SPHERE), (2, foam::CAPSULE), (1, foam::BOX)] {
        let elements = region.cover(count, kinds)?;
        let first = elements.all()[0];
        println!("{} of kind {}, the first at {:.3?}: covered {}", elements.all().len(), first.kind, first.position,
                 region.is_covered_by(&elements)?);
    }
    // What is wrong, the library says.
    match foam::Region::of_mesh(&vertices[..5], &triangles) {
        Err(text) => println!("{text}"),
        Ok(_) => return Err("a triangle without its corner passed".into()),
    }
    Ok(())
}
